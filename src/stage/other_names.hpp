#pragma once
// What other programs call the stages: decimate, weld, boolean. For hints only; a stage has one name.

#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// The name of the stage that other programs call so; empty when there is none.
std::string_view stage_called(std::string_view other_name);

/// What to say of what other programs have as one operation and some stages do together here (remesh), in the
/// syntax of a pipeline; empty for other words.
std::string_view chain_called(std::string_view other_name);

/// What to say about a word that names no stage: what it is called here, or the nearest of the names.
std::string hint_for_stage(std::string_view word, const std::vector<std::string>& names);

} // namespace facetmill

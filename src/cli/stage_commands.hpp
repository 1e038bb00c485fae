#pragma once
// A stage typed as if it were a command: facetmill validate --watertight part.stl.

#include "stage/stage.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::cli {

/// Whether a bare word is a file such as outline.svg, for a stage whose bare value is something else and that
/// writes one.
bool names_result(const StageInfo& stage, const std::string& word);

/// What to write for words whose first means the stage and that go on as other programs have it, with files
/// and options: "facetmill pipe load part.stl ! validate --closed; facetmill validate --help lists its
/// options".
std::string as_pipe(std::string_view stage, const std::vector<std::string>& words);

} // namespace facetmill::cli

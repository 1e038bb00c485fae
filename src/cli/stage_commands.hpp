#pragma once
// Hints for a stage typed as a command: facetmill validate --watertight part.stl.

#include "stage/stage.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::cli {

/// Whether a bare word is an output file such as outline.svg, for a stage that writes files but whose bare
/// value is something else.
bool names_result(const StageInfo& stage, const std::string& word);

/// The command to type instead, for words that begin with a stage and continue with files and options as in
/// other programs: "facetmill pipe load part.stl ! validate --closed; facetmill validate --help lists its
/// options".
[[nodiscard]] std::string as_pipe(std::string_view stage, const std::vector<std::string>& words);

} // namespace facetmill::cli

#pragma once
// Saves a pipeline as a file, for --save.

#include "options/value.hpp"

namespace facetmill::cli {

/// Writes the pipeline as a file that run reproduces; "-" prints it. Inputs become relative to the file.
/// Outputs stay relative to the working directory, as run expects. Throws a usage error (E-SAVE), and the
/// errors of parse_yaml for a path that is not UTF-8.
void save_pipeline(Value document, const std::vector<std::string>& reports, const std::string& target);

} // namespace facetmill::cli

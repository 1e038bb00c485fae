#pragma once
// Parses the one-liner into a document: "load a.stl ! relax 3 ! write a.glb" becomes the same tree as the
// pipeline in YAML. Its marks point into the command line. The plan validates stages and options.

#include "cli/command.hpp"
#include "options/declaration.hpp"

namespace facetmill::cli {

/// Parses the stages from argument `first` on into a document of format 1. Adds problems of the one-liner's
/// syntax (E-PIPE), for example a missing ! between stages. Options of pipe itself (own; null: unknown)
/// after a stage are also problems.
[[nodiscard]] Value parse_pipe(const CommandLine& line, std::size_t first, Problems& problems,
                               const Arguments* own = nullptr);

} // namespace facetmill::cli

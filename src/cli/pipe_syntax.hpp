#pragma once
// The one-liner as a document: "load a.stl ! relax 3 ! write a.glb" becomes the tree that the same pipeline
// in YAML becomes, with marks that point into the command line. What stages and options there are, the plan
// judges.

#include "cli/command.hpp"
#include "options/declaration.hpp"

namespace facetmill::cli {

/// The stages from argument first on, as a document of format 1. Problems of the one-liner's own syntax
/// (E-PIPE) are added, also of a missing ! between stages, and of options of pipe itself (own; null: none are
/// known) that stand behind a stage.
Value parse_pipe(const CommandLine& line, std::size_t first, Problems& problems,
                 const Arguments* own = nullptr);

} // namespace facetmill::cli

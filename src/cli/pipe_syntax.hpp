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

/// An argument as a value of that option (null: unknown): "@{x}" is "${x}", "50pct" is "50%", vectors and
/// lists are split at commas (lists of paths are not: a path may hold a comma), and what stands in braces, or
/// in brackets within brackets, is read as YAML where the option may be such a thing. Problems of that YAML
/// are added.
Value pipe_value(std::string text, const Option* option, const Mark& mark, Problems& problems);

/// The options of a stage by dotted name: "plane.normal". Null when there is none.
const Option* find_dotted(const Declaration& declaration, std::string_view name);

} // namespace facetmill::cli

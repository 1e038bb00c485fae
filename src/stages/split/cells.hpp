#pragma once
// split, of a mesh in cells.

#include "stages/split/options.hpp"

namespace facetmill::split_stage {

/// Why the options need the mesh in memory, in words; none when they do not.
std::optional<std::string> why_not_on_cells(const SplitOptions& o);
double triangles_of_one(const SplitOptions& o);
void split_on_cells(const SplitOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::split_stage

#pragma once
// The stage split for a mesh in cells.

#include "stages/split/options.hpp"

namespace facetmill::split_stage {

/// The reason for messages why the options need the mesh in memory; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_on_cells(const SplitOptions& o);
[[nodiscard]] double triangles_of_one(const SplitOptions& o);
void split_on_cells(const SplitOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::split_stage

#pragma once
// The stage crumple for a mesh in cells.

#include "stages/crumple/options.hpp"

namespace facetmill::crumple_stage {

/// The reason for messages why the options need the mesh in memory; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_on_cells(const CrumpleOptions& o);
[[nodiscard]] double triangles_of_one(const CrumpleOptions& o);
void crumple_on_cells(const CrumpleOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::crumple_stage

#pragma once
// What becomes of the attributes when a stage moves vertices and leaves the connectivity alone.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Call it after positions changed: wedge attribute NORMAL is recomputed, TANGENT (float32 or float64) is
/// made perpendicular to it again, the others are as they were. Returns the fate of every attribute, in the
/// mesh's order.
Fates settle_moved(Mesh& mesh);

/// Takes the part along NORMAL out of the wedge attribute TANGENT (float32 or float64); whether there was
/// one.
bool straighten_tangents(Mesh& mesh);

} // namespace facetmill

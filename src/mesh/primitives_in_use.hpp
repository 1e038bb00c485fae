#pragma once
// Primitives that something is drawn with: a stage that removes faces leaves the table of primitives as it
// is.

#include "mesh/mesh.hpp"

#include <vector>

namespace facetmill {

/// [primitives] whether faces or lines are of the primitive; each is, where the mesh has only points. O(faces
/// + lines).
[[nodiscard]] std::vector<bool> primitives_in_use(const Mesh& mesh);

} // namespace facetmill

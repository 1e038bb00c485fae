#pragma once
// Finds primitives that faces or lines use. A stage that removes faces does not change the table of
// primitives.

#include "mesh/mesh.hpp"

#include <vector>

namespace facetmill {

/// [primitives] Whether faces or lines use the primitive. All true if the mesh has only points. O(faces +
/// lines).
[[nodiscard]] std::vector<bool> primitives_in_use(const Mesh& mesh);

} // namespace facetmill

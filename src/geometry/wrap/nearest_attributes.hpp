#pragma once
// Takes attributes from the nearest points of another mesh.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Fills the attributes of a mesh of triangles without seams from another surface, or from points. See wrap
/// for the treatment of each attribute.
[[nodiscard]] AttributeChanges take_nearest_attributes(Mesh& mesh, const Mesh& source);

} // namespace facetmill

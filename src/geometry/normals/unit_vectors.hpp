#pragma once
// Normals and tangents of length 1, and joint weights of sum 1, as glTF requires.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Scales normals and tangents whose length is not 1, and sets the sign of tangents to 1 or -1. A normal
/// without a direction gets the mean of its faces, weighted by area. Then mends the joint weights of each
/// element: negative and undefined weights become 0, repeated joints are merged, and the sum becomes 1. The
/// sum of integers becomes exactly their maximum. Without any weight, the first joint gets 1. Other values
/// stay. mended: gets the number of vectors and sets of weights that changed. O(n).
[[nodiscard]] AttributeChanges scale_to_unit(Mesh& mesh, std::size_t& mended);

} // namespace facetmill

#pragma once
// Unit lengths of normals and tangents, and unit sums of joint weights.

#include "mesh/mesh.hpp"

namespace facetmill::clean_stage {

/// Scales normals and tangents to length 1, and the weights of each wedge over all sets to the sum 1. A
/// normal without a direction gets the sum of the area vectors of its faces, and weights of the sum 0 become
/// 1 for the first joint. Values within the limits of the checks unit_normals and weights_normalized stay.
/// Returns the changes of all attributes. scaled: the number of changed vectors and wedges is added.
[[nodiscard]] AttributeChanges scale_to_unit(Mesh& mesh, std::size_t& scaled);

} // namespace facetmill::clean_stage

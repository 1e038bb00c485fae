#pragma once
// Several meshes as one.

#include "geometry/simplify/simplify.hpp"

namespace facetmill::simplification {

/// All in one, the faces numbered by where they are from. Primitives stay numbers.
Mesh joined(std::span<const Mesh* const> meshes);
/// What became of each mesh, from what became of all.
std::vector<SimplifyResult> split_up(SimplifyResult all, std::span<const Mesh* const> meshes);

} // namespace facetmill::simplification

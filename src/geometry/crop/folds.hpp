#pragma once
// Where a wall lies on the surface that it closes. For crop only.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Removes triangles of walls, the faces from first_wall on, and the kept triangles of the same three
/// vertices the other way round, where an edge of theirs has more than two faces: a fold without volume,
/// between corners that rounding has put beside each other. Each edge loses both its uses by the two, so what
/// was closed is closed. Attributes stay with their faces. Returns how many triangles of walls went.
std::size_t remove_folds(Mesh& mesh, std::size_t first_wall);

} // namespace facetmill

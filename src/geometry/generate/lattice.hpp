#pragma once
// Surfaces on a cubic lattice: cube and Menger sponge.

#include "mesh/mesh.hpp"

#include <cstdint>

namespace facetmill {

/// The surface of the cube of side 1 around the origin, cells x cells quads on each side.
Mesh lattice_cube(std::int64_t cells);

/// The outer surface of the Menger sponge of side 1 around the origin, one quad for every lattice face
/// between the sponge and empty space: 2 * 20^level + 4 * 8^level quads, closed and manifold. level 0 to 6.
Mesh lattice_sponge(int level);

} // namespace facetmill

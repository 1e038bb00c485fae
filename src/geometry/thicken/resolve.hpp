#pragma once
// Removes folds from the solid between a closed surface and its moved copies.

#include "geometry/thicken/thicken.hpp"

#include <cstdint>
#include <vector>

namespace facetmill {

/// The surface and its moves.
struct ThickenMoves {
    const Mesh& surface;                ///< must be closed and consistently oriented
    const std::vector<Vec3>& of_vertex; ///< the vertex moves for a distance of 1 in the world
    double out = 0,
           in = 0; ///< outward move of the front and inward move of the back, in the world; 0: no move
    std::vector<std::uint8_t>
        no_front = {},
        no_back = {}; ///< [faces] 1: the face is absent on that side, which the other side fills
};

struct ResolvedSolid {
    Mesh mesh;
    std::vector<std::uint8_t> is_back; ///< [faces] 1 for faces of the back
    AttributeChanges changes;
    bool failed = false; ///< if true, all other members are empty
};

/// The solid is the inside of the front minus the inside of the back. A point is inside a moved copy if the
/// copy winds around it at least once. A fold winds around its region backward, or twice. A copy that passes
/// through the surface would remove walls. Therefore it is combined with copies at 1/2, 1/4, down to 1/16 of
/// the distance. The back becomes the intersection of these copies, and the front their union. The wall
/// becomes thinner at these points but stays complete. Pieces that enclose less than a cube of the thickness
/// (in the world) are removed. Uses the Boolean operations of geometry/boolean/combine.hpp. The result does
/// not depend on the number of threads.
[[nodiscard]] ResolvedSolid resolved_solid(const ThickenMoves& moves, const Transform& to_world);

/// Resolves a solid that passes through itself: keeps all points with a winding number of at least 1.
/// Removes small pieces.
[[nodiscard]] ResolvedSolid united_solid(const Mesh& solid, const Transform& to_world, double thickness);

} // namespace facetmill

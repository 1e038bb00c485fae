#pragma once
// The solid between a closed surface and its moved copies, where these fold over: without the folds.

#include "geometry/thicken/thicken.hpp"

#include <cstdint>
#include <vector>

namespace facetmill {

/// What moves, and how far.
struct ThickenMoves {
    const Mesh& surface;                ///< closed, consistently oriented
    const std::vector<Vec3>& of_vertex; ///< for a distance of 1 in world
    double out = 0, in = 0;             ///< of the front outward, of the back inward, in world; 0: it stays
    std::vector<std::uint8_t> no_front = {},
                              no_back = {}; ///< [faces] 1: that side is not there (the other fills it)
};

struct ResolvedSolid {
    Mesh mesh;
    std::vector<std::uint8_t> is_back; ///< [faces]
    AttributeChanges changes;
    bool failed = false; ///< the rest is empty
};

/// What is inside of the front and not inside of the back, where a moved copy of the surface counts for what
/// it winds around at least once: a fold winds around what it covers backward, or twice. Where the copy
/// passes through the surface itself, which would take walls away, it stands together with copies half as
/// far, a quarter, up to a sixteenth: the back for what is inside of each, the front for what is inside of
/// any. So the wall is thinner there, and not gone. Pieces of a side that enclose less than a cube of the
/// thickness (in world) are left out. Boolean operations as in geometry/boolean/combine.hpp: the same for any
/// number of threads.
[[nodiscard]] ResolvedSolid resolved_solid(const ThickenMoves& moves, const Transform& to_world);

/// A solid of that thickness that passes through itself as what it winds around at least once, without small
/// pieces.
[[nodiscard]] ResolvedSolid united_solid(const Mesh& solid, const Transform& to_world, double thickness);

} // namespace facetmill

#pragma once
// Solids of terrains: a surface, its straight copy along an axis, and walls between them.

#include "mesh/mesh.hpp"

#include <optional>

namespace facetmill {

struct ExtrudeSettings {
    std::size_t axis = 2;             ///< 0 x, 1 y, 2 z, in the space that to_world leads to
    std::optional<double> level = {}; ///< the copy is flat, at this coordinate along the axis
    double length = 0;                ///< without a level: the copy is moved by this distance; negative: down
    Transform to_world{};             ///< not singular
};

/// The reason why there is no solid.
enum class NoSolid {
    none,
    overhangs,     ///< the surface lies above itself
    closed,        ///< it is closed already
    mixed,         ///< some faces look up, others down
    edge_on,       ///< no face can be seen along the axis
    level_crosses, ///< the level is between its lowest and its highest vertex
};

struct ExtrudeResult {
    NoSolid refused = NoSolid::none;
    std::optional<Vec3> at;   ///< for `overhangs`: a place, in the world
    double low = 0, high = 0; ///< the surface's extent along the axis, in the world
    Mesh mesh;
    AttributeChanges changes;
    std::size_t wall_faces = 0;
};

/// Makes a closed, oriented solid of an open surface that no line along the axis meets twice. The surface
/// keeps its vertices. Its other side is a reversed copy: moved along the axis, or flat at a level. Walls
/// follow the boundary edges. Vertices that are exactly at the level stay, so the solid has no wall there,
/// and faces at the level vanish. Which way the surface looks does not matter. Sheets that meet at a
/// non-manifold edge or vertex are separated first. Attributes as for thicken, but a flat side gets its own
/// normals. O(n log n).
[[nodiscard]] ExtrudeResult extrude(const Mesh& mesh, const ExtrudeSettings& settings);

} // namespace facetmill

#pragma once
// Adds thickness to surfaces and lines, and backs to surfaces. Follows P. Bourke, "Facets, planes, normals,
// rendering" (1992).

#include "mesh/mesh.hpp"

#include <optional>

#include <cstddef>
#include <cstdint>

namespace facetmill {

/// The position of the new wall relative to the original surface.
enum class ThickenSide { outward, inward, centred };

struct ThickenSettings {
    double thickness = 1; ///< above zero, in the space that to_world leads to
    ThickenSide side = ThickenSide::inward;
    double miter_limit = 3;         ///< a vertex moves by at most this multiple of the distance; at least 1
    bool self_intersections = true; ///< counts self-intersections in the result
    Transform to_world{};           ///< transform to the space in which thickness is measured; not singular
    /// Rebuilds a solid that folds over or passes through itself, without its folds. Uses the Boolean
    /// operations of geometry/boolean/combine.hpp. The solid must be closed once it has walls.
    bool resolve = false;
};

struct ThickenResult {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t wall_faces = 0; ///< faces of walls along boundary edges
    std::size_t limited = 0;    ///< vertices limited by miter_limit
    std::size_t still = 0;      ///< unmoved vertices: without a normal, or unused by faces
    /// World distances from the vertices and face centres of the front to the back.
    struct Wall {
        double thinnest = 0, mean = 0;
    };
    std::optional<Wall> wall; ///< empty unless both sides have faces
    std::size_t unbalanced =
        0; ///< unbalanced edges of the result, because the surface was not oriented consistently
    std::size_t filled = 0; ///< closed components that became filled solids because one side vanished
    std::size_t turned = 0; ///< faces of front and back that the move turned over (see turned_faces)
    std::optional<Vec3> first_turned; ///< the centre, in world, of the original of the first turned face
    /// Pairs of faces; pairs that only touch do not count. Not counted if the thickness exceeds the size of
    /// the surface, because nearly all would intersect. This does not apply if all components became filled
    /// solids.
    std::optional<std::size_t> self_intersections;
    std::size_t buried = 0; ///< closed components within the walls of others, if no faces intersect
    /// With `resolve`: whether the solid was rebuilt. If so, turned and buried are 0. If rebuilding fails,
    /// the solid is the same as without `resolve`.
    bool resolved = false;
    /// The Euler numbers of a closed surface and of a side of the rebuilt solid. A thin wall has sides like
    /// its surface; others lost or gained holes, handles or pieces where walls met.
    struct Topology {
        std::int64_t surface = 0, side = 0;
    };
    std::optional<Topology> changed_topology; ///< empty if both sides are like the surface
};

/// Makes a solid of the surface. The front is the surface, moved outward by the thickness or half of it if
/// requested. The back is a reversed copy at the distance of the thickness, and walls follow the boundary
/// edges.
/// A closed surface becomes a solid with a cavity. If no ball of that radius fits into a closed component,
/// it has no cavity, and the other side bounds a filled solid.
/// A vertex moves so that the planes of its faces move by the distance, in the least-squares sense. The
/// weights are the angles of the faces at the vertex. miter_limit limits longer moves.
/// Flat faces that turn over in their plane are triangulated again (geometry/thicken/redrawn_flats.hpp).
/// Other folds remain unless `resolve` is set. The solid is correct if turned, self_intersections and buried
/// are 0. wall shows its thin parts. Wedges of the back have reversed normals. Walls have their own normals
/// if the mesh has normals. The result is closed only if the surface is oriented consistently. Sheets that
/// meet at a non-manifold edge or vertex are separated first, as clean does. Each becomes its own solid. A
/// mesh without faces stays unchanged. O(n log n).
[[nodiscard]] ThickenResult thicken(const Mesh& mesh, const ThickenSettings& settings);

struct WiresSettings {
    double thickness = 1;   ///< diameter, in the space that to_world leads to; above zero
    int sides = 8;          ///< sides of each cylinder, 3 or more
    bool open_only = false; ///< only edges with a single face
    Transform to_world{};   ///< transform to the space in which cylinders are round; not singular
};

struct WiresResult {
    Mesh mesh;
    std::size_t edges = 0, skipped = 0; ///< skipped: edges of length 0
};

/// Turns edges into cylinders: a closed cylinder around every edge, with flat ends at the vertices. The
/// result has no attributes.
[[nodiscard]] WiresResult wires(const Mesh& mesh, const WiresSettings& settings);

struct TwoSidedResult {
    Mesh mesh;
    AttributeChanges changes;
};

/// Appends a reversed copy of each face. Faces that already have a back at the same positions get none, so a
/// second run changes nothing. The back has its own vertices, except that both sides share the vertices on
/// open edges. An open surface becomes a closed surface without volume. An inner edge between two vertices
/// on boundary edges then has four faces. Wedges of the back have their own attributes, with reversed
/// normals. Face attributes are copied.
[[nodiscard]] TwoSidedResult two_sided(const Mesh& mesh);

} // namespace facetmill

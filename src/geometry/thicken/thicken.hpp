#pragma once
// Surfaces and lines that get a thickness, and surfaces a back. After P. Bourke, "Facets, planes, normals,
// rendering" (1992).

#include "mesh/mesh.hpp"

#include <optional>

#include <cstddef>

namespace facetmill {

/// Where the new wall stands to the surface that was there.
enum class ThickenSide { outward, inward, centred };

struct ThickenSettings {
    double thickness = 1; ///< above zero; in the space that to_world leads to
    ThickenSide side = ThickenSide::inward;
    double miter_limit = 3;         ///< a vertex moves at most so many times the distance, at least 1
    bool self_intersections = true; ///< count them in the result
    Transform to_world{};           ///< where thickness is meant and measured; not singular
    /// A solid that folds over or passes through itself is made again without its folds (by the boolean
    /// operations of geometry/boolean/combine.hpp); for what is closed once it has walls.
    bool resolve = false;
};

struct ThickenResult {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t wall_faces = 0; ///< along boundary edges
    std::size_t limited = 0;    ///< vertices that miter_limit held back
    std::size_t still = 0;      ///< vertices without a normal (or of no face): they did not move
    /// Distances in world from vertices and middles of faces of the front to the back.
    struct Wall {
        double thinnest = 0, mean = 0;
    };
    std::optional<Wall> wall; ///< none when nothing has both sides
    std::size_t unbalanced =
        0;                  ///< edges of the result that are not closed: the surface was not oriented there
    std::size_t filled = 0; ///< closed components whose walls fill them: one side vanished, and is not there
    std::size_t turned = 0; ///< faces of front and back that their move turned over (see turned_faces)
    std::optional<Vec3>
        first_turned; ///< the middle, in world, of the face of the surface that the first is of
    /// Pairs of faces. Not looked for when the thickness is more than the surface is large, unless it is
    /// filled: nearly all meet.
    std::optional<std::size_t> self_intersections;
    std::size_t buried = 0; ///< closed components within the walls of others, when no faces intersect
    /// With `resolve`: whether it was made again; turned and buried are 0 then, and self_intersections leaves
    /// out pairs that only touch. When that was needed and did not succeed, the solid is as without
    /// `resolve`.
    bool resolved = false;
};

/// Makes a solid of the surface: the front as it is (moved outward by the thickness, or half of it), a copy
/// of it turned round at the thickness behind, and walls along boundary edges. A closed surface becomes a
/// hollow solid with a cavity; where no ball of that radius fits into a closed component there is no cavity,
/// and the solid is what the other side bounds. A vertex moves so that the planes of its faces move by the
/// distance each, as nearly as one point allows (least squares, weighted by the angles of the faces at the
/// vertex); where that goes farther than miter_limit it is held back. A side that folds over is left as it
/// is unless `resolve` is set: the solid is right where turned, self_intersections and buried are 0, and thin
/// where the wall is. Wedges of the back have normals turned; walls have their own when the mesh has normals.
/// Requires a consistently oriented surface to be closed afterwards. Sheets that meet at an edge of more than
/// two faces, or only at a vertex, are taken apart first, as clean does: each becomes a solid of its own. A
/// mesh without faces stays as it is. O(n log n).
[[nodiscard]] ThickenResult thicken(const Mesh& mesh, const ThickenSettings& settings);

struct WiresSettings {
    double thickness = 1;   ///< diameter, in the space that to_world leads to, above zero
    int sides = 8;          ///< of each cylinder, 3 or more
    bool open_only = false; ///< only the edges with one face
    Transform to_world{};   ///< where they are round; not singular
};

struct WiresResult {
    Mesh mesh;
    std::size_t edges = 0, skipped = 0; ///< skipped: without length
};

/// Lines become cylinders: a closed cylinder around every edge, with flat ends at the vertices. Without
/// attributes.
[[nodiscard]] WiresResult wires(const Mesh& mesh, const WiresSettings& settings);

struct TwoSidedResult {
    Mesh mesh;
    AttributeChanges changes;
};

/// The faces once more, in reversed order, after the others, but for those that have a back at the same
/// places already: so the second time changes nothing. The back has its own vertices, but for those on open
/// edges, which both sides share: an open surface becomes a closed one of no volume (an inner edge between
/// two vertices on boundary edges then has four faces). Wedges of the back have their own attributes, with
/// normals turned; face attributes are copied.
[[nodiscard]] TwoSidedResult two_sided(const Mesh& mesh);

} // namespace facetmill

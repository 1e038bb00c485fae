#pragma once
// Simplification: edges are collapsed, cheapest first, until a target is met.

#include "base/functions.hpp"
#include "geometry/normal_seams.hpp"

#include <optional>

namespace facetmill {

struct SimplifySettings {
    enum class Method {
        quadric,       ///< Garland and Heckbert: least sum of squared distances to the planes of the faces
        shortest_edge, ///< the note's: the shortest edge goes, and the rest meets at its midpoint
    };
    enum class Boundary {
        along,  ///< boundary edges collapse along the boundary only
        locked, ///< boundary vertices stay, all of them
    };
    Method method = Method::quadric;
    Boundary boundary = Boundary::along;
    double crease = 30 * pi / 180; ///< radians, see merge_normal_seams; 0: every normal seam stays
    // At least one target; the first one met stops the work.
    std::optional<double> ratio =
        {}; ///< of the triangles that came in, 0 < ratio <= 1; the count is rounded up
    std::optional<std::size_t> faces = {};    ///< at most so many triangles
    std::optional<std::size_t> vertices = {}; ///< at most so many vertices
};

struct SimplifyResult {
    enum class Stop {
        nothing,  ///< the mesh was at or below every target already: it is returned as it was
        ratio,    ///< met
        faces,    ///< met
        vertices, ///< met
        stuck,    ///< no collapse was left that keeps the guarantees
    };
    /// Edges that were left because a collapse would have broken something; counted when the work stopped as
    /// stuck.
    struct Blocked {
        std::size_t borders = 0;  ///< boundary, seam and material borders, non-manifold places
        std::size_t topology = 0; ///< would change genus, close a hole, or make a component vanish
        std::size_t flips = 0;    ///< would flip or flatten a face
    };
    Mesh mesh;
    Fates fates;
    Stop stop = Stop::nothing;
    Blocked blocked;
    NormalSeams::Shading shading = NormalSeams::Shading::as_given; ///< what was done about normal seams
    std::size_t merged_wedges = 0;                                 ///< by them
    std::size_t faces_given = 0;                                   ///< as they came, polygons too
    std::size_t faces_before = 0, faces_after = 0;                 ///< triangles
    std::size_t vertices_before = 0, vertices_after = 0;           ///< used by faces
    std::size_t collapses = 0;
    std::size_t passes = 0;
    /// quadric: the largest distance (root mean square over the planes gathered in a new vertex) at any
    /// collapse; shortest-edge: half the longest edge that was collapsed. In the mesh's units.
    double largest_error = 0;
};

/// Simplifies a mesh.
///
/// Requires nothing: open, non-manifold and degenerate input is worked on, except within reach of its
/// non-manifold or inconsistently oriented vertices, which stay with all their edges. Polygons are
/// triangulated first. Vertices that no face uses are dropped.
///
/// Guarantees: every collapse satisfies the link condition, so a manifold stays manifold, a closed surface
/// closed, and the genus, the number of components and of boundary loops stay; a closed component keeps at
/// least four faces. No collapse turns a face by more than 60 degrees, makes one degenerate or doubles one.
/// Boundaries, UV and normal seams, and borders of primitives collapse only along themselves; where more than
/// two of them meet, or one ends, the vertex stays. Vertices that were not moved keep their exact position.
///
/// Attributes: a vertex or wedge that moved has those of the surface that came in, at the nearest point of
/// the faces around all the vertices that went into it (on a feature line: of that line, so that both sides
/// match); the others keep theirs, and so do faces. Seams that only normals make are merged first, see
/// merge_normal_seams. The vertices and faces come out along a Morton curve.
///
/// Errors: usage (E-RANGE) when no target or one out of range is given. About O(n log n), parallel; the same
/// bytes for any number of threads. Source: the note 'Surface simplification' (1997); Garland & Heckbert,
/// 'Surface simplification using quadric error metrics' (1997).
SimplifyResult simplify(Mesh mesh, const SimplifySettings& settings);

} // namespace facetmill

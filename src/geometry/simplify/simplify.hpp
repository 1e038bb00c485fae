#pragma once
// Simplification: edges are collapsed, cheapest first, until a target is met. The one header of this folder
// that others include.

#include "base/math/portable_math.hpp"
#include "base/refusal.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/normals/normals.hpp"
#include "mesh/plane.hpp"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace facetmill {

/// What stays vertex by vertex.
struct SimplifyLocks {
    bool boundary = false;     ///< the vertices of boundary edges
    bool seams = false;        ///< the vertices of seams and of borders of primitives
    bool groups = false;       ///< the vertices of borders between values of the face attribute "group"
    std::vector<Plane> body{}; ///< the vertices in front of all of these, in the mesh's space; empty: none
    std::vector<std::uint8_t> vertices{}; ///< [vertices] 1 for those that stay; empty: none
    /// No edge comes to join two of `vertices` that none joined before: of pieces of one surface that are
    /// simplified one by one, two would get it, and it would have four faces.
    bool apart = false;
};

/// What no collapse of the method constrained may bring about; 0 leaves a constraint out.
struct SimplifyConstraints {
    double least_cosine = 0.5; ///< of the angle between a face's normal and the one that it came with
    double aspect_ratio = 0;   ///< no face gets a larger one (mesh/aspect_ratio.hpp), unless one was worse
    double roundness = 0; ///< no face gets a smaller one: 1 for an equilateral triangle, 0 for a flat one
    double hausdorff = 0; ///< no vertex that went is farther from the faces near by, in the mesh's units
};

/// What attributes weigh in the error of the quadric methods; 0 leaves one out.
struct AttributeWeights {
    /// UV sets: a texture that slides by a length counts as much as `uv` times a surface off by that length.
    double uv = 0.5;
    // A difference of 1 counts as much as a surface that is off by the weight times 1 % of the diagonal.
    double normal = 0.1; ///< of unit vectors
    double colour = 1;   ///< of full intensity
    double skin = 1;     ///< of skin weights: all of a joint's pull
};

struct SimplifySettings {
    enum class Method {
        quadric, ///< Garland and Heckbert: least sum of squared distances to the planes of the faces
        quadric_endpoints, ///< the same, but the new vertex is one of the two: vertices are a subset
        constrained,       ///< OpenMesh's decimater: quadric, endpoints only, under SimplifyConstraints
        shortest_edge,     ///< the shortest edge goes, and the rest meets at its midpoint
        cluster, ///< the vertices in each cell of a grid become one: for previews, topology is not kept
    };
    enum class Topology {
        keep,  ///< genus, components and boundary loops stay
        allow, ///< components may vanish, holes close, and handles be pinched off
    };
    enum class Intersections {
        ignore, ///< not looked for
        count,  ///< counted before and after
        avoid,  ///< no more pairs of faces that run into each other than there were
    };
    Method method = Method::quadric;
    Topology topology = Topology::keep;
    Intersections self_intersections = Intersections::ignore;
    AttributeWeights weights{}; ///< for quadric and quadric-endpoints
    SimplifyLocks lock{};
    SimplifyConstraints constraints{}; ///< for the method constrained
    /// Radians, see merge_normal_seams (0: every normal seam stays); and of corners of boundaries, see
    /// shortest_edge.
    double feature_angle = 30 * pi / 180;
    // At least one target; the first one met stops the work.
    std::optional<double> ratio =
        {}; ///< of the triangles that came in, 0 < ratio <= 1; the count is rounded up
    std::optional<std::size_t> faces = {};    ///< at most so many triangles
    std::optional<std::size_t> vertices = {}; ///< at most so many vertices
    /// The deviation from the mesh that came in, measured both ways (geometry/deviation/deviation.hpp, its
    /// seed), stays within this. In the mesh's units.
    std::optional<double> max_error = {};
    std::size_t samples = 100000; ///< each way, that max_error is judged by
    /// For quadric and quadric-endpoints: no collapse has a larger error (see
    /// SimplifyResult::largest_error). In the mesh's units.
    std::optional<double> max_quadric_error = {};
    /// Levels of detail: ratios, descending. No other target may be given then.
    std::vector<double> levels = {};
};

struct SimplifyResult {
    enum class Stop {
        nothing,           ///< the mesh was at or below every target already: it is returned as it was
        ratio,             ///< met
        faces,             ///< met
        vertices,          ///< met
        max_error,         ///< any more would deviate too much
        max_quadric_error, ///< any more would have a larger error
        stuck,             ///< no collapse was left that keeps the guarantees
    };
    /// Edges that were left because a collapse would have broken something; counted when the work stopped as
    /// stuck, for max_error or for max_quadric_error.
    struct Blocked {
        std::size_t borders = 0;      ///< boundaries and locks; and where faces would cross, with avoid
        std::size_t seams = 0;        ///< at a seam, or a border of primitives or groups
        std::size_t non_manifold = 0; ///< at a vertex that is not manifold
        std::size_t topology = 0;     ///< would change genus, close a hole, or make a component vanish
        std::size_t flips = 0;        ///< would flip or flatten a face
        std::size_t error = 0;        ///< would move the surface too far
    };
    Mesh mesh;
    AttributeChanges changes;
    /// [vertices of mesh] the vertex that each was, or that a vertex which moved took the place of, among
    /// those that faces used; only with locks of single vertices, else empty.
    std::vector<Index> sources = {};
    Stop stop = Stop::nothing;
    bool unchanged = false; ///< no collapse was made: the mesh is as it came
    Blocked blocked;
    NormalSeams::Shading shading = NormalSeams::Shading::as_given; ///< what was done about normal seams
    std::size_t merged_wedges = 0;                                 ///< by them
    /// Faces that the work was done on turned round, so that neighbours agree; in `mesh` they face as they
    /// did.
    std::size_t turned = 0;
    std::size_t faces_given = 0;                         ///< as they came, polygons too
    std::size_t faces_before = 0, faces_after = 0;       ///< triangles
    std::size_t vertices_before = 0, vertices_after = 0; ///< used by faces
    std::size_t collapses = 0;                           ///< that led to the mesh
    std::size_t rolled_back = 0;                         ///< that were taken back for max_error
    std::size_t measurements = 0;                        ///< that max_error took
    std::optional<double> measured; ///< the deviation when max_error was given, in the mesh's units
    std::optional<std::size_t> intersections_before = {}, intersections_after = {}; ///< when counted
    std::size_t held = 0; ///< vertices that less error was allowed to, to avoid self-intersections
    std::size_t passes = 0;
    /// quadric and cluster: the largest distance (root mean square over the planes gathered in a new vertex)
    /// at any collapse; shortest-edge: half the longest edge that was collapsed; constrained: none. In the
    /// mesh's units.
    std::optional<double> largest_error;
    std::optional<double> cell; ///< cluster: the edge of the grid's cells, in the mesh's units
};

/// Simplifies a mesh.
///
/// Requires nothing: open, non-manifold and degenerate input is worked on, except within reach of its
/// non-manifold vertices, which stay with all their edges. Where neighbours face opposite ways the work is
/// done as if they agreed (cluster aside), and every face that is left faces as it did; surfaces that cannot
/// be oriented (a Moebius strip) count as not manifold where their neighbours disagree. Polygons are
/// triangulated first. Vertices that no face uses are dropped.
///
/// Guarantees: every collapse satisfies the link condition, so a manifold stays manifold, a closed surface
/// closed, and the genus, the number of components and of boundary loops stay; a closed component keeps at
/// least four faces. No collapse turns a face by more than 60 degrees, makes one degenerate or doubles one.
/// Boundaries, UV and normal seams, and borders of primitives and groups collapse only along themselves;
/// where more than two of them meet, or one ends, the vertex stays; with shortest_edge so do the vertices
/// where a boundary turns by more than the feature angle. Vertices that were not moved keep their exact
/// position. Open borders that run along each other at exactly the same places, as of patches that were never
/// welded, collapse as the two sides of a seam and stay apart (with quadric, quadric-endpoints and
/// shortest-edge).
///
/// max_error: every vertex and centre of a face that came in is followed to a face near by, and a collapse is
/// refused when it leaves one farther than 9/10 of the bound from the faces around, or when the new vertex or
/// the centre of a face at it is as far from the surface that came in. All collapses are logged, and the
/// deviation of the result is measured. If it is above the bound, the log is cut by bisection: every
/// beginning of it is a mesh with all the guarantees. Nothing is run again.
///
/// self_intersections: avoid: where the result runs into itself more often than the mesh that came in, all
/// vertices that went into the faces concerned may take part in collapses of half the error only, and
/// all is done again, until none is new; after ten rounds they stay as they were. It works on one mesh, not
/// on levels.
///
/// The method constrained keeps boundaries, seams and borders vertex by vertex, and gives no largest_error;
/// max_error and levels are refused.
///
/// topology: allow leaves the link condition out: the last faces of a component may go (not with max_error,
/// which must find every point near by), holes of three edges close, and edges and vertices where handles
/// were may end up with more than two faces or fans. Closedness, flips and features are kept as always.
///
/// The method cluster (J. Rossignac and P. Borrel, 'Multi-resolution 3D approximations for rendering complex
/// scenes', 1993; placed after P. Lindstrom, 'Out-of-core simplification of large polygonal models', 2000)
/// makes one vertex of all in a cell, where their planes meet best; faces that keep three vertices stay. It
/// keeps neither topology nor borders, and refuses locks, levels and self_intersections: avoid. Its targets
/// are met by the size of the cells: the finest grid that was found to be at or below; sheets thinner than a
/// cell become double faces.
///
/// Weights: the attributes are linear over the faces that came in, and every new vertex pays the squared
/// difference to what they would be at its place, by area (H. Hoppe, 'New quadric metric for simplifying
/// meshes with appearance attributes', 1999; the best value at the vertex is eliminated, so that the sum is
/// again a quadric). Skin weights go through a fixed random projection to four numbers.
///
/// Attributes: a vertex or wedge that moved has those of the surface that came in, at the nearest point of
/// the faces around all the vertices that went into it (on a feature line: of that line, so that both sides
/// match); the others keep theirs, and so do faces. Seams that only normals make are merged first, see
/// merge_normal_seams. The vertices and faces come out along a Morton curve.
///
/// Errors in the order: where neighbouring faces turn by more than 90 degrees, planes upright on them hold
/// the edge, by the cosine, as they hold boundaries. Where more than a sixteenth of the edges cost less than
/// single precision tells, costs below it are worked out in double precision; among what is left, errors of
/// 1e-5 of the edges' lengths, the shorter edge goes first.
///
/// Errors: usage for the first that check_simplify_settings refuses. About O(n log n), parallel; the same
/// bytes for any number of threads. Source: M. Garland and P. Heckbert, 'Surface simplification using quadric
/// error metrics' (1997).
SimplifyResult simplify(Mesh mesh, const SimplifySettings& settings);

/// All that simplify refuses, the first of which it throws first of all: settings that do not go together
/// (E-CONFLICT), then no target, or settings out of range (E-RANGE).
std::vector<Refusal> check_simplify_settings(const SimplifySettings& settings);

/// One result per ratio of settings.levels, from fine to coarse: a chain in which each level is made from the
/// one before by further collapses, so a vertex of a coarse level stands for a set of vertices of the finer
/// one, largest_error never falls, and borders that match in one part match in all. ratio, faces, vertices
/// and max_error must not be given. collapses are those since the mesh that came in. Throws the first that
/// check_simplify_levels refuses.
std::vector<SimplifyResult> simplify_levels(Mesh mesh, const SimplifySettings& settings);

/// As check_simplify_settings, of simplify_levels.
std::vector<Refusal> check_simplify_levels(const SimplifySettings& settings);

// The parts of a scene, with one target for all.

/// What is refused (E-CONFLICT) of settings that meshes cannot share; thrown before what
/// check_simplify_settings refuses.
std::optional<Refusal> check_simplify_sharing(const SimplifySettings& settings);

/// How the parts of a scene are simplified together, and what is measured of them.
struct SimplifyPartsSettings {
    SimplifySettings all;               ///< for all selected parts together; lengths and planes of the world
    std::vector<std::uint8_t> selected; ///< [parts] 1 for those that are simplified
    /// For quadric, quadric-endpoints and shortest-edge: edges are collapsed in one order of cost over all
    /// parts. Otherwise each part meets the ratio, or its share of faces and vertices, separately.
    bool by_error = true;
    std::optional<double> max_of_diagonal = {}; ///< max_quadric_error as a fraction of each part's diagonal
    bool measure = true, certify = false;       ///< the deviation; and a guaranteed bound of it
    std::function<SurfaceSize(std::size_t part)> size_before; ///< in the world, of a part as it came
};

/// A simplified part, or a level of one.
struct SimplifiedPart {
    /// The size of a surface.
    struct Size {
        double area = 0;
        std::optional<double> volume; ///< when closed
    };
    struct Topology {
        Properties before, after;
    };
    /// Of the surface, in the world.
    struct Sizes {
        Size before, after;
    };
    SimplifyResult result;                     ///< without its mesh in reports
    double scale = 1;                          ///< takes lengths from the part's space to the scene's
    std::optional<double> max_quadric_error{}; ///< the limit, in scene units
    std::string part;
    std::optional<std::vector<std::string>> joint_with;
    std::optional<Topology> topology; ///< of methods that may change it
    std::optional<Sizes> sizes;       ///< when measured
    std::optional<DeviationResult> deviation;
    std::optional<SurfaceSize> surface{}; ///< when this very part was measured
};

/// Simplifies the selected parts, one after the other, and passes on the levels of each (one without levels).
/// Parts of the same transform, attributes and shading whose borders touch are simplified as one. Other
/// borders that touch another part keep their vertices, so that all match. Parts with equal meshes are
/// simplified once. The meshes of the selected parts are used up: `take` gets the new ones.
void simplify_parts(Scene& scene, const SimplifyPartsSettings& settings,
                    const std::function<void(std::size_t part, std::vector<SimplifiedPart> levels)>& take);

/// Triangles after triangulation, and vertices.
struct MeshCounts {
    std::size_t triangles = 0, vertices = 0;
};
/// Of the selected parts together.
MeshCounts count_selected(const Scene& scene, const std::vector<std::uint8_t>& selected);

} // namespace facetmill

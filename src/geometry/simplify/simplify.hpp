#pragma once
// Simplification: edges are collapsed, cheapest first, until a target is met. Code outside this folder
// includes only this header.

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

/// Vertices that must stay.
struct SimplifyLocks {
    bool boundary = false;     ///< the vertices of boundary edges
    bool seams = false;        ///< the vertices of seams and of borders of primitives
    bool groups = false;       ///< the vertices of borders between values of the face attribute "group"
    std::vector<Plane> body{}; ///< vertices in front of all these planes, in the mesh's space; empty: none
    std::vector<std::uint8_t> vertices{}; ///< [vertices] 1 for vertices that stay; empty: none
    /// No collapse creates an edge between two of `vertices`. If the pieces of a surface are simplified
    /// separately, two pieces could create the same edge, which would then have four faces.
    bool apart = false;
};

/// Limits for each collapse of the method constrained; 0 disables a constraint.
struct SimplifyConstraints {
    double least_cosine = 0.5; ///< least cosine of the angle between a face's normal and its original normal
    double aspect_ratio =
        0; ///< no face gets a larger ratio (mesh/aspect_ratio.hpp), unless a face was already worse
    double roundness = 0; ///< no face gets a smaller value: 1 for an equilateral triangle, 0 for a flat one
    double hausdorff =
        0; ///< no removed vertex is farther than this from the nearby faces, in the mesh's units
};

/// The weights of attributes in the error of the quadric methods; 0 ignores an attribute.
struct AttributeWeights {
    /// UV sets: a texture that slides by a length counts as much as a surface that is off by `uv` times this
    /// length.
    double uv = 0.5;
    // A difference of 1 counts as much as a surface that is off by the weight times 1 % of the diagonal.
    double normal = 0.1; ///< weight of unit normals
    double colour = 1;   ///< weight of colours, where 1 is full intensity
    double skin = 1;     ///< weight of skin weights, where 1 is the full influence of a joint
};

struct SimplifySettings {
    enum class Method {
        quadric, ///< Garland and Heckbert: least sum of squared distances to the planes of the faces
        quadric_endpoints, ///< like quadric, but the new vertex is one of the two ends, so that vertices are
                           ///< a subset of the input's
        constrained,       ///< OpenMesh's decimater: quadric, endpoints only, under SimplifyConstraints
        shortest_edge,     ///< the shortest edge is collapsed to its midpoint
        cluster, ///< merges the vertices in each cell of a grid; for previews, because topology is not kept
    };
    enum class Topology {
        keep,  ///< genus, components and boundary loops stay
        allow, ///< components may vanish, holes close, and handles be pinched off
    };
    enum class Intersections {
        ignore, ///< self-intersections are not searched
        count,  ///< self-intersections are counted before and after
        avoid,  ///< no more intersecting pairs of faces than in the input
    };
    Method method = Method::quadric;
    Topology topology = Topology::keep;
    Intersections self_intersections = Intersections::ignore;
    AttributeWeights weights{}; ///< for quadric and quadric-endpoints
    SimplifyLocks lock{};
    SimplifyConstraints constraints{}; ///< for the method constrained
    /// In radians: the angle for merge_normal_seams (0: every normal seam stays), and for corners of
    /// boundaries with shortest_edge.
    double feature_angle = 30 * pi / 180;
    // At least one target must be given. The first target that is met stops the work.
    std::optional<double> ratio =
        {}; ///< share of the input triangles, 0 < ratio <= 1; the count is rounded up
    std::optional<std::size_t> faces = {};    ///< the maximum number of triangles
    std::optional<std::size_t> vertices = {}; ///< the maximum number of vertices
    /// The deviation from the input mesh, measured in both directions (geometry/deviation/deviation.hpp, its
    /// seed), stays within this bound. In the mesh's units.
    std::optional<double> max_error = {};
    std::size_t samples = 100000; ///< samples in each direction, to measure max_error
    /// For quadric and quadric-endpoints: no collapse has a larger error (see SimplifyResult::largest_error).
    /// In the mesh's units.
    std::optional<double> max_quadric_error = {};
    /// Levels of detail: ratios, descending. No other target may be given then.
    std::vector<double> levels = {};
};

struct SimplifyResult {
    enum class Stop {
        nothing,           ///< the mesh already met every target: it is returned unchanged
        ratio,             ///< the ratio was met
        faces,             ///< the target number of faces was met
        vertices,          ///< the target number of vertices was met
        max_error,         ///< any further collapse would deviate too much
        max_quadric_error, ///< any further collapse would have a larger error
        stuck,             ///< every remaining collapse would break a guarantee
    };
    /// Edges that could not be collapsed without breaking a guarantee. Counted when the work stopped as
    /// stuck, for max_error or for max_quadric_error.
    struct Blocked {
        std::size_t borders = 0;      ///< boundaries and locks; with avoid, also where faces would intersect
        std::size_t seams = 0;        ///< at a seam, or a border of primitives or groups
        std::size_t non_manifold = 0; ///< at a non-manifold vertex
        std::size_t topology = 0;     ///< would change genus, close a hole, or make a component vanish
        std::size_t flips = 0;        ///< would flip or flatten a face
        std::size_t error = 0;        ///< would move the surface too far
    };
    Mesh mesh;
    AttributeChanges changes;
    /// [vertices of mesh] the source of each vertex, or of the vertex whose position a moved vertex took,
    /// numbered among the vertices that faces used. Empty unless single vertices are locked.
    std::vector<Index> sources = {};
    Stop stop = Stop::nothing;
    bool unchanged = false; ///< no edge was collapsed, so the mesh equals the input
    Blocked blocked;
    NormalSeams::Shading shading = NormalSeams::Shading::as_given; ///< how normal seams were handled
    std::size_t merged_wedges = 0;                                 ///< wedges merged along normal seams
    /// Faces reversed during the work, so that neighbours agree. In `mesh` they have their original
    /// orientation.
    std::size_t turned = 0;
    std::size_t faces_given = 0;                         ///< faces of the input, including polygons
    std::size_t faces_before = 0, faces_after = 0;       ///< triangle counts
    std::size_t vertices_before = 0, vertices_after = 0; ///< vertices that faces use
    std::size_t collapses = 0;                           ///< the collapses that the mesh includes
    std::size_t rolled_back = 0;                         ///< collapses undone because of max_error
    std::size_t measurements = 0;                        ///< measurements made for max_error
    std::optional<double> measured; ///< the deviation if max_error was given, in the mesh's units
    std::optional<std::size_t> intersections_before = {}, intersections_after = {}; ///< counts, if requested
    std::size_t held = 0; ///< vertices whose error limit was lowered to avoid self-intersections
    std::size_t passes = 0;
    /// In the mesh's units. quadric and cluster: the largest distance at any collapse, as the root mean
    /// square over the planes of a new vertex. shortest-edge: half the longest collapsed edge. constrained:
    /// none.
    std::optional<double> largest_error;
    std::optional<double> cell; ///< cluster: the edge length of the grid's cells, in the mesh's units
};

/// Simplifies a mesh. Has no preconditions: open, non-manifold and degenerate input is accepted.
/// Non-manifold vertices stay, with all edges between them.
///
/// First, polygons are triangulated, unused vertices dropped, and normal-only seams merged
/// (merge_normal_seams). If neighbouring faces disagree, faces are reversed during the work (not for cluster)
/// and restored at the end. A non-orientable surface (a Moebius strip) counts as not manifold there.
///
/// Guarantees: every collapse satisfies the link condition, so manifoldness, closedness, the genus and the
/// numbers of components and boundary loops stay. A closed component keeps at least four faces. No collapse
/// turns a face by more than 60 degrees, or makes a face degenerate or double. Boundaries, UV and normal
/// seams, and borders of primitives and groups collapse only along themselves. Their ends and crossings
/// stay; with shortest_edge also the boundary corners sharper than the feature angle. Unmoved vertices keep
/// their exact position. Coincident borders collapse as the two sides of a seam (quadric, quadric-endpoints
/// and shortest-edge).
///
/// max_error: bounds the measured deviation. Points of the input surface are followed during the collapses
/// (bounds.cpp). If the final deviation exceeds the bound, the log of collapses is cut by bisection. Every
/// prefix of the log is a mesh with all guarantees.
///
/// self_intersections: avoid: while the result intersects itself more often than the input, the work is
/// repeated, with half the error at the intersecting faces. After ten rounds their vertices stay fixed. Not
/// for levels.
///
/// Methods: constrained keeps boundaries, seams and borders vertex by vertex, and has no largest_error,
/// max_error or levels. cluster (J. Rossignac and P. Borrel, 'Multi-resolution 3D approximations for
/// rendering complex scenes', 1993; placement after P. Lindstrom, 'Out-of-core simplification of large
/// polygonal models', 2000) merges the vertices in each grid cell, and keeps at most one coincident face per
/// side. Its targets set the cell size: the finest grid found that meets them. It keeps neither topology nor
/// borders, and refuses locks, levels and self_intersections: avoid.
///
/// topology: allow drops the link condition, so components may vanish (not with max_error), and holes and
/// handles may close. Edges and vertices may become non-manifold; closedness, flips and features are kept.
///
/// Attributes: a moved vertex or wedge has the attributes of the input surface at its nearest point
/// (attributes.hpp). Weights add the attribute error to the quadrics (H. Hoppe, 'New quadric metric for
/// simplifying meshes with appearance attributes', 1999). The result is in Morton order.
///
/// Throws the first refusal of check_simplify_settings as a usage error. About O(n log n), parallel; the
/// same bytes for any number of threads. Source: M. Garland and P. Heckbert, 'Surface simplification using
/// quadric error metrics' (1997).
[[nodiscard]] SimplifyResult simplify(Mesh mesh, const SimplifySettings& settings);

/// All settings that simplify refuses, in its order of reporting. First come settings that exclude each other
/// (E-CONFLICT), then a missing target, or settings out of range (E-RANGE).
[[nodiscard]] std::vector<Refusal> check_simplify_settings(const SimplifySettings& settings);

/// Returns one result per ratio of settings.levels, from fine to coarse. Each level continues the collapses
/// of the one before, so a vertex of a coarse level represents a set of vertices of the finer level.
/// largest_error never falls, and borders that match in one part match in all. ratio, faces, vertices and
/// max_error must not be given. collapses counts from the input mesh. Throws the first refusal of
/// check_simplify_levels.
[[nodiscard]] std::vector<SimplifyResult> simplify_levels(Mesh mesh, const SimplifySettings& settings);

/// Like check_simplify_settings, for simplify_levels.
[[nodiscard]] std::vector<Refusal> check_simplify_levels(const SimplifySettings& settings);

// Simplifying the parts of a scene with a common target.

/// The first conflict (E-CONFLICT) of settings with a shared target; thrown before the refusals of
/// check_simplify_settings.
[[nodiscard]] std::optional<Refusal> check_simplify_sharing(const SimplifySettings& settings);

/// Settings for simplifying the parts of a scene together, and for measuring them.
struct SimplifyPartsSettings {
    SimplifySettings all; ///< for all selected parts together; lengths and planes in world space
    std::vector<std::uint8_t> selected; ///< [parts] 1 for parts to simplify
    /// For quadric, quadric-endpoints and shortest-edge: edges are collapsed in a single order of cost over
    /// all parts. Otherwise each part meets the ratio, or its share of faces and vertices, separately.
    bool by_error = true;
    std::optional<double> max_of_diagonal = {}; ///< max_quadric_error as a fraction of each part's diagonal
    bool measure = true, certify = false;       ///< the deviation, and a guaranteed bound of it
    std::function<SurfaceSize(std::size_t part)> size_before; ///< world size of an input part
};

/// The largest deviation of a skinned or morphed part over sampled poses, in scene units.
struct PosedDeviation {
    std::size_t poses = 0; ///< the number of compared poses
    double maximum = 0;
    double percent = 0; ///< of the diagonal of the input in that pose
    std::string pose;   ///< the name of the pose with the maximum
};

/// A simplified part, or one of its levels.
struct SimplifiedPart {
    /// The size of a surface.
    struct Size {
        double area = 0;
        std::optional<double> volume; ///< the volume, if the surface is closed
    };
    struct Topology {
        Properties before, after;
    };
    /// Sizes of the surface, in the world.
    struct Sizes {
        Size before, after;
    };
    SimplifyResult result;                     ///< reports get it without its mesh
    double scale = 1;                          ///< scale of lengths from the part's space to the scene's
    std::optional<double> max_quadric_error{}; ///< the limit, in scene units
    std::string part;
    std::optional<std::vector<std::string>> joint_with;
    std::optional<Topology> topology; ///< the topology, for methods that may change it
    std::optional<Sizes> sizes;       ///< the sizes, if measured
    std::optional<DeviationResult> deviation;
    std::optional<PosedDeviation> posed{};
    std::optional<SurfaceSize> surface{}; ///< set if this part itself was measured
};

/// Simplifies the selected parts one by one, and passes on the levels of each (one entry without levels).
/// Parts with the same transform, attributes and shading whose borders touch are merged for the work. Other
/// borders that touch another part keep their vertices, so that all match. Parts with equal meshes are
/// simplified once. Consumes the meshes of the selected parts: `take` gets the new ones.
void simplify_parts(Scene& scene, const SimplifyPartsSettings& settings,
                    const std::function<void(std::size_t part, std::vector<SimplifiedPart> levels)>& take);

/// Counts of triangles (after triangulation) and vertices.
struct MeshCounts {
    std::size_t triangles = 0, vertices = 0;
};
/// The total of the selected parts.
[[nodiscard]] MeshCounts count_selected(const Scene& scene, const std::vector<std::uint8_t>& selected);

} // namespace facetmill

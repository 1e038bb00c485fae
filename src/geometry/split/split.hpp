#pragma once
// Splits faces into smaller ones, by many methods, without cracks.

#include "base/refusal.hpp"
#include "mesh/provenance.hpp"

#include <optional>
#include <string>

namespace facetmill {

enum class SplitMethod {
    midpoint,      ///< edges halved: triangle -> 4 triangles, quad -> 4 quads, n-gon -> n quads around its
                   ///< centroid
    bisect,        ///< triangles cut across their longest edge, see SplitSettings::cut
    notch,         ///< triangles cut between the middles of their two longest edges: a triangle and a quad
    centroid,      ///< every n-gon -> n triangles around its centroid
    grid,          ///< triangle -> n * n triangles, quad -> n x n quads
    quads,         ///< every n-gon -> n quads around its centroid
    halve,         ///< quads cut in two between the middles of their longer pair of opposite edges
    fan,           ///< quads and larger -> triangles around the centroid; triangles stay
    varignon,      ///< every n-gon -> the n-gon of its edge midpoints and n triangles at its corners
    core,          ///< every n-gon -> the same shape at half size around its centroid and n quads
    diagonal,      ///< quads -> 2 triangles along a diagonal, as triangulated() does; triangles stay
    loop,          ///< smooth, triangles -> 4
    sqrt3,         ///< smooth, triangles -> 3
    butterfly,     ///< smooth and through the old vertices, triangles -> 4
    catmull_clark, ///< smooth, every n-gon -> n quads
};

/// Whether the method moves the surface: loop, sqrt3, butterfly, catmull_clark. Sources: C. Loop, "Smooth
/// subdivision surfaces based on triangles" (1987), with the boundary rules of H. Biermann, A. Levin and D.
/// Zorin, "Piecewise smooth subdivision surfaces with normal control" (2000); L. Kobbelt,
/// "Sqrt(3)-subdivision" (2000); D. Zorin, P. Schroeder and W. Sweldens, "Interpolating subdivision for
/// meshes with arbitrary topology" (1996); E. Catmull and J. Clark, "Recursively generated B-spline surfaces
/// on arbitrary topological meshes" (1978).
bool is_smooth(SplitMethod method);
/// The method as users write it: "catmull-clark".
[[nodiscard]] const char* to_string(SplitMethod method);

/// The words of a split in messages.
struct SplitWords {
    std::string subject = "split"; ///< the subject of each message
    std::string fewer =
        "use fewer passes, a coarser grid or a longer max_edge"; ///< the hint if the result is too large
};

struct SplitSettings {
    enum class Cut {
        longest_edge, ///< in the middle of the longest edge
        widest_angle, ///< at the foot of the bisector of the widest angle, which is opposite to that edge (a
                      ///< thousandth of the edge from its ends at least); not with a target
    };
    SplitMethod method = SplitMethod::midpoint;
    int passes = 1;              ///< number of passes, at least 0; with a target, the maximum
    int grid = 2;                ///< pieces per edge of SplitMethod::grid; at least 1
    Cut cut = Cut::longest_edge; ///< position of bisect's cut
    double max_edge = 0;         ///< target in world units: no edge is longer (0: no target)
    double min_angle =
        0; ///< target in radians: splits only triangles with an angle below this (0: no target)
    std::uint64_t max_faces =
        0; ///< target: the longest edges are cut first, up to this number of faces (0: no target)
    std::optional<double> feature_angle = {}; ///< for smooth methods, in radians: edges whose faces meet at a
                                              ///< larger angle stay sharp (empty: only boundaries)
    Transform to_world = {}; ///< from the part's space to the world, where lengths and angles are measured
    SplitWords words = {};
};

struct SplitResult {
    enum class Stop {
        passes,  ///< the requested number of passes was done
        target,  ///< no edge is longer than max_edge, or no triangle narrower than min_angle
        budget,  ///< the next cut would have made more than SplitSettings::max_faces
        narrow,  ///< a pass would have made more triangles narrower than min_angle
        nothing, ///< no edge has a length
    };
    Mesh mesh;
    AttributeChanges changes; ///< changes of the attributes
    std::size_t added = 0;    ///< number of added faces
    int passes = 0;           ///< completed passes
    Stop stop = Stop::passes;
    std::size_t folded = 0;        ///< faces whose pieces overlap (folding_faces), summed over passes
    std::size_t narrow = 0;        ///< with min_angle: remaining triangles that have a smaller angle
    std::size_t narrow_before = 0; ///< such triangles before the split
    std::size_t shared = 0; ///< spots where two faces share two edges, so that their new edges coincide and
                            ///< have more than two faces; summed over passes
};

/// Splits every face. Open, closed and non-manifold meshes stay conforming: a point on an edge is a single
/// vertex for all its faces, with a wedge per pair of wedges (seams stay seams). Old vertices keep their
/// numbers and, except with smooth methods, their positions. New faces replace the old face in order and
/// keep its direction, so a closed mesh stays closed. The Euler characteristic and manifoldness stay too,
/// except where two faces share two edges, whose new edges merge (SplitResult::shared). varignon leaves such
/// corners whole; diagonal uses the other diagonal if that is sound. Concave faces are cut to their centre
/// (centre_weights), so that no new face is flipped. SplitResult::folded counts the exceptions: faces
/// without a kernel, and concave faces cut by grid, halve or varignon. Closures match a face to the points
/// that neighbours put on its edges. midpoint, quads, varignon and grid put the same points on every edge,
/// and centroid, fan, core and diagonal put none. bisect marks the longest edge of each triangle that is
/// split or has a marked edge, until nothing changes (Rivara; ties: the edge of lower vertices). Triangles
/// are cut at their longest edge first, then the halves at theirs. Cut::widest_angle uses the triangle with
/// the wider angle at the edge (ties: the lower face). notch marks two edges of each triangle: one mark cuts
/// it to the opposite corner, two give a triangle and a quad, three four triangles. Between passes
/// triangulated() cuts the quads. halve treats triangles as notch does; a quad with one more mark loses a
/// triangle from that half, with two more it becomes four quads around its centroid. Targets end at
/// SplitSettings::passes at the latest; SplitResult::stop has the reason. max_edge: bisect marks only longer
/// edges; midpoint, quads and the smooth methods that make four faces split all faces. min_angle: bisect or
/// notch only split narrower triangles (and the closure). With bisect no angle falls below half the smallest
/// (I. Rosenberg and F. Stenger, "A lower bound on the angles of triangles constructed by bisecting the
/// longest side", 1975). A pass that would make more narrow triangles is not done. max_faces: bisect cuts
/// the longest edges first; other methods do the passes that fit. Smooth methods have the masks of
/// OpenMesh's subdividers, which test them (sources: is_smooth). They require a manifold, consistently
/// oriented mesh. Feature edges follow H. Hoppe et al., "Piecewise smooth surface reconstruction" (1994):
/// cubic B-spline along them (butterfly: four-point curve). A vertex with three or more feature edges, or at
/// the end of a boundary, stays. A vertex with a single feature edge is smooth. Requires a valid mesh.
/// Throws a stage error (E-POLYGON) for faces of too many corners: above four for grid, halve and diagonal,
/// above three for bisect, notch, loop, sqrt3 and butterfly. Throws a stage error (E-MANIFOLD) for smooth
/// methods on unsuitable meshes, a usage error (E-CONFLICT) for targets that the method cannot reach, and a
/// limit error, before building, beyond 2^31 corners (E-LIMIT) or memory (E-MEMORY). Vertex and wedge
/// attributes are interpolated (smooth methods recompute normals); face attributes are copied. After P.
/// Bourke, "Splitting facets" (1991).
[[nodiscard]] SplitResult split(const Mesh& mesh, const SplitSettings& settings);

/// The refusal (E-CONFLICT) of targets that the method cannot reach. split throws it before other errors.
[[nodiscard]] std::optional<Refusal> check_split_targets(const SplitSettings& settings);

/// split with SplitMethod::grid: each triangle becomes n * n triangles, and each quad n x n quads. Shared
/// edges get the same n
/// - 1 points. n = 1 returns the mesh.
[[nodiscard]] SplitResult grid_split(const Mesh& mesh, int n, const SplitWords& words = {});

/// The edge lengths and angles of a mesh, in world space.
struct FacetShape {
    double longest_edge = 0; ///< 0 without faces
    double smallest_angle =
        0; ///< in radians, over all corners between edges of nonzero length; 0 without faces
};
[[nodiscard]] FacetShape facet_shape(const Mesh& mesh, const Transform& to_world = {});
/// The mean over all corners of the length of the edge that begins at the corner; 0 without faces.
[[nodiscard]] double mean_edge(const Mesh& mesh, const Transform& to_world = {});

/// Spots at counted vertices where triangles share two edges, so that their new edges coincide. This is
/// SplitResult::shared of a pass that cuts all edges, for a mesh that is processed in parts. counted:
/// [vertices] 1 if all faces of the vertex are present; empty: all vertices.
[[nodiscard]] std::size_t shared_spots(const Mesh& mesh, const std::vector<std::uint8_t>& counted);

/// The approximate number of corners of the result. It is an upper bound, except for bisect and smooth
/// methods with max_edge (split checks again before every pass). A real number, because it may exceed any
/// integer.
[[nodiscard]] double split_corner_estimate(const Mesh& mesh, const SplitSettings& settings);

} // namespace facetmill

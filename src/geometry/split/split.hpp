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

/// Whether the method moves the surface: loop, sqrt3, butterfly, catmull_clark.
bool is_smooth(SplitMethod method);
/// The method as users write it: "catmull-clark".
const char* to_string(SplitMethod method);

/// How messages speak of a split.
struct SplitWords {
    std::string subject = "split"; ///< leads each of them
    std::string fewer =
        "use fewer passes, a coarser grid or a longer max_edge"; ///< the hint where it is too large
};

struct SplitSettings {
    enum class Cut {
        longest_edge, ///< in the middle of the longest edge
        widest_angle, ///< where the bisector of the widest angle, which is opposite to that edge, meets it (a
                      ///< thousandth of the edge from its ends at least); not with a target
    };
    SplitMethod method = SplitMethod::midpoint;
    int passes = 1;              ///< how many times; at least 0. With a target: at most so often
    int grid = 2;                ///< pieces per edge of SplitMethod::grid; at least 1
    Cut cut = Cut::longest_edge; ///< of bisect
    double max_edge = 0;         ///< target, world units: until no edge is longer (0: none)
    double min_angle = 0;        ///< target, radians: only triangles with an angle below (0: none)
    std::uint64_t max_faces = 0; ///< target: longest edges first, and never more faces than this (0: none)
    std::optional<double> feature_angle = {}; ///< smooth methods, radians: edges whose faces meet at a larger
                                              ///< angle stay sharp (none: only boundaries do)
    Transform to_world = {};                  ///< part space -> world, where lengths and angles are measured
    SplitWords words = {};
};

struct SplitResult {
    enum class Stop {
        passes,  ///< as many as were asked for
        target,  ///< no edge is longer than max_edge, or no triangle narrower than min_angle
        budget,  ///< the next cut would have made more than SplitSettings::max_faces
        narrow,  ///< a pass would have made more triangles narrower than min_angle
        nothing, ///< no edge has a length
    };
    Mesh mesh;
    AttributeChanges changes; ///< what became of the attributes
    std::size_t added = 0;    ///< faces more than before
    int passes = 0;           ///< done
    Stop stop = Stop::passes;
    std::size_t folded = 0; ///< faces whose pieces lie over each other (folding_faces), summed over passes
    std::size_t narrow = 0; ///< with min_angle: triangles left that have a smaller angle
    std::size_t narrow_before = 0; ///< such triangles that there were
    std::size_t shared = 0; ///< spots where two faces share two edges, so that new edges of theirs coincide
                            ///< and have more than two faces; summed over passes
};

/// The mesh with every face split. Conforming on open, closed and non-manifold meshes: a point on an edge is
/// one vertex for all faces at the edge, with one wedge per pair of wedges there (seams stay seams), computed
/// once with the edge's ends in index order. Old vertices keep their numbers and, but for the smooth methods,
/// their places; the faces that replace a face follow each other in its place and keep its direction, so a
/// closed mesh stays closed. Euler's number and manifoldness stay too, but where two faces share two edges
/// (triangles back to back, for one): new edges between these are one edge of both, which SplitResult::shared
/// counts. varignon leaves such corners whole, diagonal takes the other diagonal where that is sound.
///
/// Concave quads are cut to the middle of their inner diagonal and larger concave faces to the centroid of
/// their kernel (centre_weights), so that no new face looks the other way. Larger faces without a kernel, and
/// concave ones that grid, halve and varignon cut, cannot be cut so; SplitResult::folded counts them.
///
/// Closures, where a neighbour puts points on a face's edges: midpoint, quads, varignon and grid put the same
/// points on every edge, so none is needed; centroid, fan, core and diagonal put none. bisect marks the
/// longest edge of each triangle that is split (ties: the edge of lower vertices) and of each triangle with a
/// marked edge, until nothing changes (Rivara); a triangle is cut at its longest edge first, then its halves
/// at theirs: two pieces, or three or four. With Cut::widest_angle the point is the one of the triangle with
/// the wider angle at that edge (ties: the lower face). notch marks two edges of each triangle: with one mark
/// a triangle is cut to the opposite corner, with two it becomes a triangle and a quad, with three four
/// triangles; before another pass triangulated() cuts the quads. halve marks the edges at which quads are
/// cut: triangles as for notch; a quad with one mark more cuts a triangle off the half there, with two more
/// it becomes four quads around its centroid.
///
/// Targets, which end at SplitSettings::passes at the latest: SplitResult::stop says why it ended. max_edge:
/// with bisect only edges longer than that are marked, again and again; with midpoint, quads and the smooth
/// methods of four faces all faces are split until it holds. min_angle: bisect or notch of the triangles with
/// a smaller angle (and the closure). No angle becomes smaller than half the smallest there was with bisect
/// (I. Rosenberg and F. Stenger, "A lower bound on the angles of triangles constructed by bisecting the
/// longest side", 1975). Since a split only divides angles, narrow triangles become smaller but not fewer:
/// SplitResult::narrow counts those that are left, and a pass that would make more of them is not done.
/// max_faces: with bisect the longest edges first, with other methods as many passes as fit.
///
/// Smooth methods: C. Loop, "Smooth subdivision surfaces based on triangles" (1987), with the boundary rules
/// of H. Biermann, A. Levin and D. Zorin, "Piecewise smooth subdivision surfaces with normal control" (2000);
/// L. Kobbelt, "Sqrt(3)-subdivision" (2000); D. Zorin, P. Schroeder and W. Sweldens, "Interpolating
/// subdivision for meshes with arbitrary topology" (1996); E. Catmull and J. Clark, "Recursively generated
/// B-spline surfaces on arbitrary topological meshes" (1978). Their masks are those of OpenMesh's
/// subdividers, which test them. A feature edge follows H. Hoppe et al., "Piecewise smooth surface
/// reconstruction" (1994): cubic B-spline along it (butterfly: four-point curve), a vertex of three or more
/// feature edges or at the end of a boundary stays, one of a single feature edge is smooth. They require a
/// manifold, consistently oriented mesh.
///
/// Requires a valid mesh. Refuses (stage, E-POLYGON) faces that the method does not know: more than four
/// corners for grid, halve and diagonal, more than three for bisect, notch, loop, sqrt3, butterfly; (stage,
/// E-MANIFOLD) smooth methods on non-manifold or inconsistently oriented meshes; (usage, E-CONFLICT) targets
/// that the method cannot reach. Throws limit before anything is built when the result would have more than
/// 2^31 corners (E-LIMIT) or not fit into memory (E-MEMORY). Vertex and wedge attributes are interpolated,
/// with the smooth methods normals recomputed; face attributes are copied. After P. Bourke, "Splitting
/// facets" (1991).
SplitResult split(const Mesh& mesh, const SplitSettings& settings);

/// What is refused (E-CONFLICT) of targets that the method cannot reach; split throws it first of all.
std::optional<Refusal> check_split_targets(const SplitSettings& settings);

/// split with SplitMethod::grid: each triangle into n * n, each quad into n x n; shared edges get the same n
/// - 1 points. n = 1 returns the mesh.
SplitResult grid_split(const Mesh& mesh, int n, const SplitWords& words = {});

/// What splitting is about, in world space.
struct FacetShape {
    double longest_edge = 0;   ///< 0 without faces
    double smallest_angle = 0; ///< radians, of all corners between edges of some length; 0 without faces
};
FacetShape facet_shape(const Mesh& mesh, const Transform& to_world = {});
/// The mean over all corners of the edge that begins there; 0 without faces.
double mean_edge(const Mesh& mesh, const Transform& to_world = {});

/// Spots at counted vertices where triangles share two edges, so that new edges of theirs coincide: what
/// SplitResult::shared counts of a pass that cuts all edges, for a mesh that comes in parts. counted:
/// [vertices] 1 where all faces of the vertex are here; empty: all are.
std::size_t shared_spots(const Mesh& mesh, const std::vector<std::uint8_t>& counted);

/// About how many corners split would make (an upper bound but for bisect and smooth methods with max_edge;
/// split looks again before every pass), as a real number because it may be beyond any integer.
double split_corner_estimate(const Mesh& mesh, const SplitSettings& settings);

} // namespace facetmill

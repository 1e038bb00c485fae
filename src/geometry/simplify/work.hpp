#pragma once
// The working state of a simplification: flat arrays along a Morton curve, and the steps that work on them.
// Only geometry/simplify*.cpp include this.
//
// There is no halfedge structure. Corner c = 3 f + k of face f stands for the edge from its vertex to that of
// the next corner; the corners at a vertex form a list through `next`. A dead face has `none` as its first
// vertex; its corners stay in the lists of their vertices and are skipped.

#include "geometry/spatial/face_tree.hpp"
#include "geometry/simplify/simplify.hpp"
#include "geometry/simplify/vertex_quadric.hpp"

#include <array>
#include <limits>

namespace facetmill::simplification {

/// How freely a vertex moves. Features are the boundary, seams and borders of primitives.
enum class Kind : std::uint8_t {
    smooth, ///< no feature edge: moves freely
    curve,  ///< on one feature line: moves along it
    corner, ///< an end or a crossing of feature lines: stays, others may be collapsed into it
    pinned, ///< not manifold: stays, and so do all its edges
};

// Bits per corner.
inline constexpr std::uint8_t boundary_edge = 1, feature_edge = 2; ///< a boundary edge is a feature edge too
inline constexpr std::uint8_t blocked_border = 4, blocked_topology = 8, blocked_flip = 16, blocked_error = 32;
inline constexpr std::uint8_t blocked = blocked_border | blocked_topology | blocked_flip | blocked_error;

inline constexpr float never = std::numeric_limits<float>::infinity();

/// A collapse: b went into a, which now stands at `to` (in the surface's frame). Vertices of the mesh that
/// came in.
struct Step {
    Index a, b;
    Index wedges; ///< merges of wedges so far, those of this step included
    float error;  ///< squared, as estimated, in the surface's frame
    Vec3 to;
};
/// b went into a. Elements of the mesh that came in.
struct Merge {
    Index a, b;
};

/// All collapses in an order in which they can be made one after the other: every beginning of it is a mesh.
struct Log {
    std::vector<Step> steps;
    std::vector<Merge> wedges;
};

/// Attributes in the error: how far those of the faces around a vertex are from one value at its place.
/// Per wedge of the input when there are seams, else per vertex of the work.
struct Fields {
    std::size_t channels = 0;     ///< numbers that the attributes come down to; 0: nothing is weighed
    std::vector<Quadric> squares; ///< [elements] sum over channels and faces of area times (g.p + d)^2
    std::vector<double> sums;     ///< [elements][channels][4] sum over faces of area times g and d
};

struct Work {
    // Faces.
    std::vector<Index> tri;          ///< [3 faces] vertices
    std::vector<Index> wedge;        ///< [3 faces] wedges of the input; empty when there are no seams
    std::vector<Index> next;         ///< [3 faces] next corner at the same vertex, or none
    std::vector<std::uint8_t> flags; ///< [3 faces] bits of the edge
    std::vector<float> cost;         ///< [3 faces] cost of the edge, once per edge; never elsewhere
    std::vector<Index> face_source;  ///< [faces] face of the input
    // Vertices.
    std::vector<Vec3> at;              ///< centred and scaled, see below
    std::vector<NearQuadric> quadrics; ///< empty for shortest-edge
    Fields fields;
    std::vector<Kind> kind;
    std::vector<std::uint8_t> moved;    ///< at differs from the input's position
    std::vector<Index> first;           ///< first corner at the vertex, or none
    std::vector<Index> source;          ///< vertex of the input
    std::vector<std::uint32_t> touched; ///< pass that changed the vertex last
    std::vector<std::uint32_t> dirty; ///< pass that changed a neighbour last: what was refused may do now
    std::vector<float> limit; ///< squared error that a collapse at the vertex stays below; empty: none

    /// Only where borders touch: the vertex that each wedge of the mesh was at before they were joined. Two
    /// sides never end in one wedge, else a slit could close.
    const std::vector<Index>* sides = nullptr;

    // Only for max_error: points of the surface as it came, each kept with a face near by, as a list per
    // face.
    std::vector<Vec3> points;        ///< [points] the vertices, then the centres of the faces
    const FaceTree* given = nullptr; ///< the surface as it came, in the mesh's units
    std::vector<Index> next_point;   ///< [points] the next one with the same face, or none
    std::vector<Index> first_point;  ///< [faces] or none

    std::size_t live_faces = 0, live_vertices = 0;
    bool has_features = false;
    bool endpoints = false; ///< a new vertex is one of the two that it replaces
    bool allow = false;     ///< topology may change
    std::uint32_t pass = 1; ///< the last one, in touched
    bool logging = false;   ///< attributes, or the way back, need to know who went into whom
    Log log;
    std::vector<std::uint8_t> features_given; ///< [3 faces of the mesh] whether its corner's edge is a
                                              ///< feature; empty when there is none or nobody asks
    // at = (position - centre) * scale, scale a power of two: quadrics neither overflow nor cancel.
    Vec3 centre;
    double scale = 1;

    std::size_t face_slots() const { return tri.size() / 3; }
    std::size_t vertex_slots() const { return at.size(); }
    bool live(Index f) const { return tri[3 * f] != none; }
};

inline Index after(Index c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline Index before(Index c) { return c % 3 == 0 ? c + 2 : c - 1; }

/// Refuse (E-RANGE) settings that no mesh could serve.
void check(const SimplifySettings& settings);
void check_levels(const SimplifySettings& settings);

/// Orders a triangle mesh along a Morton curve and builds the lists. mesh: all triangles.
Work build_work(const Mesh& mesh);
/// The lists of corners per vertex, from tri.
void build_lists(Work& s);
/// Drops dead faces and vertices; orders stay.
void compact(Work& s);

/// Sets kind of the vertices and flags of the edges. Needs the lists.
void classify(Work& s, const Mesh& mesh, const SimplifyLocks& lock);

/// Sets quadrics from the faces' planes and from the planes that hold feature edges.
void sum_quadrics(Work& s);

/// Whether an edge between vertices of these kinds may be collapsed.
inline bool may_go(Kind u, Kind v, std::uint8_t flags) {
    if (u == Kind::pinned || v == Kind::pinned) return false;
    if (u == Kind::corner && v == Kind::corner) return false;
    return u == Kind::smooth || v == Kind::smooth || (flags & feature_edge); // not across a feature
}

/// What to do with an edge that may go.
struct Placement {
    Vec3 at;
    double error = 0; ///< squared distance, as far as the quadric or the edge's length tells
    bool keep_first = false, keep_second = false; ///< the new vertex is this end as it is
    NearQuadric joined{};                         ///< of the planes of both ends, about `at`
};
/// Where the ends of the edge of a corner should meet. flags: the corner's.
Placement place(const Work& s, Index corner, std::uint8_t flags);
/// What it costs to collapse the edge of a corner that may go.
float cost_of(const Work& s, Index corner, std::uint8_t flags);

/// Sets fields from the attributes of the mesh. normals: whether its normals mean anything.
void sum_fields(Work& s, const Mesh& mesh, const AttributeWeights& weights, bool normals);
/// What elements a and b would pay together at p, as a quadric of p. Its weight is not the planes'.
Quadric residual(const Fields& fields, Index a, Index b);
/// a takes over what b has.
void join_fields(Fields& fields, Index a, Index b);

/// Collapses that one worker makes; joined into the surface's totals afterwards.
struct Tally {
    std::size_t collapses = 0, faces = 0, vertices = 0; ///< faces and vertices that went
    double largest = 0;                                 ///< largest error squared, in scaled units
    Log log;
};

struct Around;
class Pricer;
enum class Attempt {
    done,
    refused, ///< it would break a guarantee: the edge is blocked and its flags say why
    outside, ///< something around the edge is beyond the territory: nothing was done
};
/// Collapses the edge of corner c if all guarantees hold, and prices the edges that changed. most:
/// Goal::error. around: scratch, with the territory.
Attempt collapse(Work& s, Index c, double most, Around& around, Pricer& pricer, Tally& tally);

/// Collapses edges until at most so many faces or vertices are left, or none can go. Returns passes, fills
/// errors.
struct Goal {
    std::size_t faces = 0, vertices = 0;
    /// Squared, in scaled units, when there are points: how far one (see Work::points) may be from the faces
    /// around, and new vertices and centres of faces from the surface as it came.
    double error = std::numeric_limits<double>::infinity();
};
struct Outcome {
    std::size_t passes = 0, collapses = 0;
    double largest = 0; ///< largest error squared, in scaled units
    bool stuck = false;
};
Outcome run_passes(Work& s, const Goal& goal);
/// The edges that the last pass left, by reason; means something once the work is stuck.
SimplifyResult::Blocked count_blocked(const Work& s);

/// What a working state was before its first collapse, as far as the way back needs it.
struct Origin {
    std::vector<Index> tri, wedge, source, face_source;
    std::vector<Vec3> at;
    std::vector<Index> number; ///< of each vertex of the mesh, in `at`

    Origin(const Work& s, std::size_t vertices);
};
/// The mesh after the first so many steps of the log: positions and faces only.
Mesh shape_after(const Work& s, const Mesh& from, const Origin& origin, std::size_t steps);
/// Takes back all steps but the first so many. The state can be finished then, and nothing else.
void roll_back(Work& s, const Origin& origin, std::size_t steps);

/// Collapses as far as the goal and the measured deviation allow.
struct Bounded {
    Outcome outcome;
    bool by_error = false; ///< the bound stopped it
    double measured = 0;   ///< the deviation of what is left
    SimplifyResult::Blocked blocked{};
    std::size_t rolled_back = 0, measurements = 0;
};
/// Sets points of the surface as it is now, see Work::points.
void place_points(Work& s);
Bounded run_within(Work& s, const Mesh& from, const Goal& goal, double max_error);

/// The method constrained. vertices: of the mesh that came in. The work can be finished afterwards, and
/// nothing else.
Outcome run_constrained(Work& s, std::size_t vertices, const Goal& goal,
                        const SimplifyConstraints& constraints);

/// The method cluster: as coarse as the goal needs, or as max_error (in the mesh's units) allows. The work
/// can be finished afterwards, and nothing else. Needs the lists, and the kinds when there are features.
struct Clustered {
    Outcome outcome;
    double cell = 0;       ///< in the mesh's units
    bool by_error = false; ///< the bound stopped it
    double measured = 0;   ///< the deviation, with max_error
    std::size_t measurements = 0;
};
Clustered run_cluster(Work& s, const Mesh& from, const Goal& goal, std::optional<double> max_error);

/// Counts the self-intersections of the work as finished (`now`); when there are more than allowed, lowers
/// the limits (see Work::limit) of all vertices of the mesh that came in that went into the vertices of the
/// faces concerned: to a part of the largest error there, or to 0.
std::size_t limit_intersecting(const Work& s, const Mesh& now, std::size_t allowed, bool to_zero,
                               std::vector<float>& limits);

/// The simplified mesh and the fates of its attributes; the wedges of `from` that are left, in its order,
/// when there are seams. The work can go on afterwards.
Mesh finished(Work& s, const Mesh& from, Fates& fates, std::vector<Index>& wedges);

} // namespace facetmill::simplification

#pragma once
// The state of a simplification: flat arrays along the curve of G. M. Morton, "A computer oriented geodetic
// data base" (1966). Private to this folder, as are all headers here but simplify.hpp.
//
// There is no halfedge structure. Corner c = 3 f + k of face f stands for the edge from its vertex to that of
// the next corner; the corners at a vertex form a list through `next`. A dead face has `none` as its first
// vertex; its corners stay in the lists of their vertices and are skipped.

#include "geometry/simplify/quadric.hpp"
#include "geometry/simplify/simplify.hpp"
#include "geometry/spatial/face_tree.hpp"

#include <array>
#include <limits>

namespace facetmill::simplification {

/// How freely a vertex moves. Features are the boundary, seams and borders of primitives and groups.
enum class Kind : std::uint8_t {
    smooth, ///< no feature edge: moves freely
    curve,  ///< on one feature line: moves along it
    corner, ///< an end or a crossing of feature lines: stays, others may be collapsed into it
    pinned, ///< not manifold: stays as a corner does, and so do the edges between two of them
};

// Bits per corner.
inline constexpr std::uint8_t boundary_edge = 1, feature_edge = 2; ///< a boundary edge is a feature edge too
inline constexpr std::uint8_t blocked_border = 4, blocked_topology = 8, blocked_flip = 16, blocked_error = 32;
inline constexpr std::uint8_t blocked = blocked_border | blocked_topology | blocked_flip | blocked_error;

inline constexpr float never = std::numeric_limits<float>::infinity();

/// Where the work is done: inside = (outside - centre) * scale, within [-1, 1]; scale is a power of two. So
/// quadrics neither overflow nor cancel.
struct Frame {
    Vec3 centre;
    double scale = 1;

    Vec3 inside(const Vec3& p) const { return (p - centre) * scale; }
    Vec3 outside(const Vec3& p) const { return p / scale + centre; }
};

/// What is left of a mesh at some point of the work, and all that a result needs of it.
struct Shape {
    Frame frame{};
    std::vector<Index> tri{};          ///< [3 faces] vertices
    std::vector<Index> wedge{};        ///< [3 faces] wedges of the input; empty without seams, as in a mesh
    std::vector<Index> face_source{};  ///< [faces] face of the input
    std::vector<Vec3> at{};            ///< [vertices] in the frame
    std::vector<Index> source{};       ///< [vertices] vertex of the input
    std::vector<std::uint8_t> moved{}; ///< [vertices] 1 when `at` is not the input's position

    std::size_t face_slots() const { return tri.size() / 3; }
    std::size_t vertex_slots() const { return at.size(); }
    bool has_seams() const { return !wedge.empty(); }
};

/// A collapse: b went into a, which now stands at `to` (in the frame). Vertices of the input.
struct Step {
    Index a, b;
    Index wedges; ///< merges of wedges so far, those of this step included
    float error;  ///< squared, as estimated, in the frame
    Vec3 to;
};
/// b went into a. Elements of the input.
struct Merge {
    Index a, b;
};
/// Collapses in an order in which they can be made one after the other: every beginning of it is a mesh.
struct Collapses {
    std::vector<Step> steps;
    std::vector<Merge> wedges;
};
/// All collapses since the input: for attributes, and for the rollback.
struct Log : Collapses {
    /// [3 faces of the input] whether the edge of the corner was a feature then; empty when none was.
    std::vector<std::uint8_t> features;
};

/// Attributes in the error: how far those of the faces around a vertex are from one value at its place. Per
/// wedge of the input when there are seams, else per vertex.
struct AttributeError {
    std::size_t channels = 0;     ///< numbers that the attributes come down to, at least 1
    std::vector<Quadric> squares; ///< [elements] sum over channels and faces of area times (g.p + d)^2
    std::vector<double> sums;     ///< [elements][channels][4] sum over faces of area times g and d
};

/// Points of the surface as it came, each kept with a face near by, as a list per face: for max_error.
struct FollowedPoints {
    struct Point {
        Vec3 at;
        Index next; ///< the next one with the same face, or none
    };
    const FaceTree* input = nullptr; ///< the surface as it came, in the mesh's units
    /// Squared, in the frame: how far a point may be from the faces around, and new vertices and places on
    /// faces from the surface as it came.
    double farthest = 0;
    std::size_t vertices = 0;       ///< of the surface as it came
    std::vector<Index> triangles{}; ///< [faces of it] where it is in the tree's order
    std::vector<Point> points{};    ///< the vertices, then the centres of the faces
    std::vector<Index> first{};     ///< [faces] or none
};

/// What the settings ask of every collapse.
struct Rules {
    bool endpoints = false;        ///< a new vertex is one of the two that it replaces
    bool changes_topology = false; ///< is allowed to
    /// [vertices of the input] 1 for those that no new edge may join; null: none
    const std::vector<std::uint8_t>* apart = nullptr;
};

/// The faces around each vertex, as lists of corners.
struct Rings {
    std::vector<Index> first; ///< [vertices] the first corner at the vertex, or none
    std::vector<Index> next;  ///< [corners] the next corner at the same vertex, or none
    std::size_t live_faces = 0, live_vertices = 0;
};

/// What is known of the edges that corners stand for.
struct Edges {
    std::vector<std::uint8_t> flags; ///< [corners] bits: features, and why it was not collapsed
    std::vector<float> cost;         ///< [corners] once per edge; never elsewhere
};

/// Which vertices features hold.
struct Features {
    std::vector<Kind> kind; ///< [vertices]
    bool any = false;       ///< edges are flagged
    /// [wedges] with coincident borders: the vertex that each wedge was at before they were joined. Two sides
    /// never end in one wedge, else a slit could close.
    const std::vector<Index>* side_of_wedge = nullptr;
};

/// What collapses cost by the planes that vertices stand for.
struct QuadricCost {
    std::vector<NearQuadric> near;                ///< [vertices]
    std::optional<std::vector<FineQuadric>> fine; ///< [vertices] the same; where much is nearly flat
    std::optional<AttributeError> attributes;     ///< none: they weigh nothing
};

/// What has changed since an edge was looked at.
struct Order {
    std::uint32_t pass = 1;             ///< the last one
    std::vector<std::uint32_t> touched; ///< [vertices] pass that changed the vertex last
    std::vector<std::uint32_t>
        dirty; ///< [vertices] pass that changed a neighbour last: what was refused may do now
};

/// How far collapses may go.
struct Bounds {
    double max_squared_error = HUGE_VAL;      ///< squared error beyond which none goes
    std::optional<std::vector<float>> limits; ///< [vertices] squared error that one there stays below
    std::optional<FollowedPoints> followed;   ///< with max_error
};

struct State : Shape {
    Rings rings;
    Edges edges;
    std::optional<Features> features;    ///< none: borders are not kept, see cluster
    std::optional<QuadricCost> quadrics; ///< none: edges cost their length
    Order order;
    Rules rules;
    Bounds bounds;
    std::optional<Log> log; ///< when attributes or a rollback need it

    bool live(Index f) const { return tri[3 * f] != none; }
    /// Whether attributes weigh in costs.
    bool weighs_attributes() const { return quadrics && quadrics->attributes; }
};

inline Index after(Index c) { return c % 3 == 2 ? c - 2 : c + 1; }
inline Index before(Index c) { return c % 3 == 0 ? c + 2 : c - 1; }

/// The vertices that faces use.
struct UsedVertices {
    std::vector<std::uint8_t> flags; ///< [vertices] 1 or 0
    std::size_t count = 0;

    explicit UsedVertices(const Mesh& mesh);
};

/// A state of all the mesh's faces and used vertices along a Morton curve, with lists and without kinds and
/// costs. mesh: all triangles.
State lay_out(const Mesh& mesh, const UsedVertices& used);
/// Drops dead faces and vertices; orders stay.
void compact(State& s);
/// Drops the vertices that no face uses; orders stay.
void drop_unused(Shape& shape);

} // namespace facetmill::simplification

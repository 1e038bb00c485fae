#pragma once
// The state of a simplification: flat arrays along the curve of G. M. Morton, "A computer oriented geodetic
// data base" (1966). Private to this folder, like every header except simplify.hpp.
//
// There is no halfedge structure. Corner c = 3 f + k of face f represents the edge from its vertex to the
// vertex of the next corner. The corners at a vertex form a list through `next`. A dead face has `none` as
// its first vertex; its corners stay in the lists of their vertices and are skipped.

#include "geometry/simplify/quadric.hpp"
#include "geometry/simplify/simplify.hpp"
#include "geometry/spatial/face_tree.hpp"

#include <array>
#include <limits>

namespace facetmill::simplification {

/// How freely a vertex moves. Features are boundaries, seams, and borders of primitives and groups.
enum class Kind : std::uint8_t {
    smooth, ///< no feature edge: moves freely
    curve,  ///< on one feature line: moves along it
    corner, ///< an end or a crossing of feature lines: stays, others may be collapsed into it
    pinned, ///< not manifold: stays like a corner, and so do the edges between two of them
};

// Flag bits of a corner.
inline constexpr std::uint8_t boundary_edge = 1, feature_edge = 2; ///< a boundary edge is a feature edge too
inline constexpr std::uint8_t blocked_border = 4, blocked_topology = 8, blocked_flip = 16, blocked_error = 32;
inline constexpr std::uint8_t blocked = blocked_border | blocked_topology | blocked_flip | blocked_error;

inline constexpr float never = std::numeric_limits<float>::infinity();

/// The frame of the computation: inside = (outside - centre) * scale, within [-1, 1]; scale is a power of
/// two. So quadrics neither overflow nor cancel.
struct Frame {
    Vec3 centre;
    double scale = 1;

    Vec3 inside(const Vec3& p) const { return (p - centre) * scale; }
    Vec3 outside(const Vec3& p) const { return p / scale + centre; }
};

/// The surviving mesh at some point of the work, with all data that a result needs.
struct Shape {
    Frame frame{};
    std::vector<Index> tri{};          ///< [3 faces] vertices
    std::vector<Index> wedge{};        ///< [3 faces] wedges of the input; empty without seams, as in a mesh
    std::vector<Index> face_source{};  ///< [faces] face of the input
    std::vector<Vec3> at{};            ///< [vertices] position in the frame
    std::vector<Index> source{};       ///< [vertices] vertex of the input
    std::vector<std::uint8_t> moved{}; ///< [vertices] 1 when `at` is not the input's position

    std::size_t face_slots() const { return tri.size() / 3; }
    std::size_t vertex_slots() const { return at.size(); }
    bool has_seams() const { return !wedge.empty(); }
};

/// A collapse: vertex b of the input merged into vertex a, which moved to `to` (in the frame).
struct Step {
    Index a, b;
    Index wedges; ///< merges of wedges so far, including this step
    float error;  ///< estimated squared error, in the frame
    Vec3 to;
};
/// An element b of the input that merged into an element a.
struct Merge {
    Index a, b;
};
/// Collapses in an order in which they can be replayed: every prefix is a mesh.
struct Collapses {
    std::vector<Step> steps;
    std::vector<Merge> wedges;
};
/// All collapses since the input: for attributes, and for the rollback.
struct Log : Collapses {
    /// [3 faces of the input] 1 if the corner's edge was a feature in the input; empty without features.
    std::vector<std::uint8_t> features;
};

/// Attributes in the error: how far the attributes of the faces around a vertex differ from a single value at
/// its position. Per wedge of the input if the mesh has seams, otherwise per vertex.
struct AttributeError {
    std::size_t channels = 0;     ///< numbers that encode the attributes, at least 1
    std::vector<Quadric> squares; ///< [elements] sum over channels and faces of area times (g.p + d)^2
    std::vector<double> sums;     ///< [elements][channels][4] sum over faces of area times g and d
};

/// Points of the input surface for max_error, each assigned to a near face, as a list per face.
struct FollowedPoints {
    struct Point {
        Vec3 at;
        Index next; ///< the next one with the same face, or none
    };
    const FaceTree* input = nullptr; ///< the input surface, in the mesh's units
    /// Squared, in the frame: the allowed distance from a point to the faces around it. It also limits the
    /// distance from new vertices and sample points on faces to the input surface.
    double farthest = 0;
    std::size_t vertices = 0;       ///< vertices of the input surface
    std::vector<Index> triangles{}; ///< [input faces] index in the tree's order
    std::vector<Point> points{};    ///< the vertices, then the centres of the faces
    std::vector<Index> first{};     ///< [faces] first point of the face, or none
};

/// The settings that apply to every collapse.
struct Rules {
    bool endpoints = false;        ///< a new vertex is one of the two ends
    bool changes_topology = false; ///< topology changes are allowed
    /// [vertices of the input] 1 for vertices that no new edge may connect; null: none
    const std::vector<std::uint8_t>* apart = nullptr;
};

/// The faces around each vertex, as lists of corners.
struct Rings {
    std::vector<Index> first; ///< [vertices] the first corner at the vertex, or none
    std::vector<Index> next;  ///< [corners] the next corner at the same vertex, or none
    std::size_t live_faces = 0, live_vertices = 0;
};

/// The flags and costs of edges, stored at their corners.
struct Edges {
    std::vector<std::uint8_t> flags; ///< [corners] bits: features, and why the edge was not collapsed
    std::vector<float> cost;         ///< [corners] at one corner per edge; the other corners have `never`
};

/// How features restrict the vertices.
struct Features {
    std::vector<Kind> kind; ///< [vertices] kinds
    bool any = false;       ///< edges are flagged
    /// [wedges] with coincident borders: the vertex of each wedge before they were joined. Two sides never
    /// merge into the same wedge; otherwise a slit could close.
    const std::vector<Index>* side_of_wedge = nullptr;
};

/// The cost of collapses, from the planes that each vertex represents.
struct QuadricCost {
    std::vector<NearQuadric> near; ///< [vertices] quadrics in single precision
    std::optional<std::vector<FineQuadric>>
        fine; ///< [vertices] quadrics in double precision, if much of the surface is nearly flat
    std::optional<AttributeError> attributes; ///< empty: attributes have no weight
};

/// Tracks the changes since an edge was last examined.
struct Order {
    std::uint32_t pass = 1;             ///< the current pass
    std::vector<std::uint32_t> touched; ///< [vertices] pass that changed the vertex last
    std::vector<std::uint32_t>
        dirty; ///< [vertices] pass that last changed a neighbour: refused edges may be allowed now
};

/// Limits on the collapses.
struct Bounds {
    double max_squared_error = HUGE_VAL; ///< no collapse has a larger squared error
    std::optional<std::vector<float>>
        limits; ///< [vertices] squared error that collapses at the vertex stay below
    std::optional<FollowedPoints> followed; ///< set with max_error
};

struct State : Shape {
    Rings rings;
    Edges edges;
    std::optional<Features> features;    ///< empty: borders are not kept, see cluster
    std::optional<QuadricCost> quadrics; ///< empty: an edge costs its length
    Order order;
    Rules rules;
    Bounds bounds;
    std::optional<Log> log; ///< set if attributes or a rollback need it

    bool live(Index f) const { return tri[3 * f] != none; }
    /// True if attributes contribute to the costs.
    bool weighs_attributes() const { return quadrics && quadrics->attributes; }
};

[[nodiscard]] inline Index after(Index c) { return c % 3 == 2 ? c - 2 : c + 1; }
[[nodiscard]] inline Index before(Index c) { return c % 3 == 0 ? c + 2 : c - 1; }

/// The vertices that faces use.
struct UsedVertices {
    std::vector<std::uint8_t> flags; ///< [vertices] 1 or 0
    std::size_t count = 0;

    explicit UsedVertices(const Mesh& mesh);
};

/// Builds a state of all faces and used vertices along a Morton curve, with lists but without kinds and
/// costs. mesh: all triangles.
[[nodiscard]] State lay_out(const Mesh& mesh, const UsedVertices& used);
/// Drops dead faces and vertices; keeps the order.
void compact(State& s);
/// Drops the vertices that no face uses; keeps the order.
void drop_unused(Shape& shape);

} // namespace facetmill::simplification

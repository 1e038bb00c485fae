#pragma once
// The working state of a simplification: flat arrays along a Morton curve, and the steps that work on them.
// Only geometry/simplify*.cpp include this.
//
// There is no halfedge structure. Corner c = 3 f + k of face f stands for the edge from its vertex to that of
// the next corner; the corners at a vertex form a list through `next`. A dead face has `none` as its first
// vertex; its corners stay in the lists of their vertices and are skipped.

#include "geometry/quadric.hpp"
#include "geometry/simplify.hpp"

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
inline constexpr std::uint8_t blocked_border = 4, blocked_topology = 8, blocked_flip = 16;
inline constexpr std::uint8_t blocked = blocked_border | blocked_topology | blocked_flip;

inline constexpr float never = std::numeric_limits<float>::infinity();

/// A collapse: b went into a, which now stands at `to` (in the surface's frame). Vertices of the mesh that
/// came in.
struct Step {
    Index a, b;
    Index wedges; ///< merges of wedges so far, those of this step included
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

struct Surface {
    // Faces.
    std::vector<Index> tri;          ///< [3 faces] vertices
    std::vector<Index> wedge;        ///< [3 faces] wedges of the input; empty when there are no seams
    std::vector<Index> next;         ///< [3 faces] next corner at the same vertex, or none
    std::vector<std::uint8_t> flags; ///< [3 faces] bits of the edge
    std::vector<float> cost;         ///< [3 faces] cost of the edge, once per edge; never elsewhere
    std::vector<Index> face_source;  ///< [faces] face of the input
    // Vertices.
    std::vector<Vec3> at;          ///< centred and scaled, see below
    std::vector<Quadric> quadrics; ///< empty for shortest-edge
    std::vector<Kind> kind;
    std::vector<std::uint8_t> moved;    ///< at differs from the input's position
    std::vector<Index> first;           ///< first corner at the vertex, or none
    std::vector<Index> source;          ///< vertex of the input
    std::vector<std::uint32_t> touched; ///< pass that changed the vertex last
    std::vector<std::uint32_t> mark;    ///< scratch of the link test

    std::size_t live_faces = 0, live_vertices = 0;
    bool has_features = false;
    bool logging = false; ///< attributes, or the way back, need to know who went into whom
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

/// Orders a triangle mesh along a Morton curve and builds the lists. mesh: all triangles.
Surface build_surface(const Mesh& mesh);
/// The lists of corners per vertex, from tri.
void build_lists(Surface& s);
/// Drops dead faces and vertices; orders stay.
void compact(Surface& s);

/// Sets kind of the vertices and flags of the edges. Needs the lists.
void classify(Surface& s, const Mesh& mesh, SimplifySettings::Boundary boundary);

/// Sets quadrics from the faces' planes and from the planes that hold feature edges.
void sum_quadrics(Surface& s);

/// What to do with an edge.
struct Placement {
    double cost = std::numeric_limits<double>::infinity(); ///< not finite: locked
    Vec3 at;
    bool keep_first = false, keep_second = false; ///< the new vertex is this end as it is
};
/// Where the ends u and v of an edge with these flags should meet, and at what cost.
Placement place(const Surface& s, Index u, Index v, std::uint8_t flags);

/// What a worker finds around an edge; reused, so that nothing is allocated per edge.
struct Rings {
    static constexpr int most = 256; ///< vertices with more faces wait until others have thinned them out
    std::array<Index, most> a, b;    ///< live corners at the two ends
    int a_size = 0, b_size = 0;
};

/// Collapses that one worker makes; joined into the surface's totals afterwards.
struct Tally {
    std::size_t collapses = 0, faces = 0, refused = 0;
    double largest = 0; ///< largest error squared, in scaled units
    Log log;
};

/// Collapses the edge of corner c if all guarantees hold, else blocks it and says why in its flags. stamp: a
/// number not yet in mark for any vertex near by; stamp + 1 is used too.
bool collapse(Surface& s, Index c, std::uint32_t pass, std::uint32_t stamp, Rings& rings, Tally& tally);

/// Collapses edges until at most so many faces or vertices are left, or none can go. Returns passes, fills
/// errors.
struct Goal {
    std::size_t faces = 0, vertices = 0;
};
struct Outcome {
    std::size_t passes = 0, collapses = 0;
    double largest = 0; ///< largest error squared, in scaled units
    bool stuck = false;
};
Outcome run_passes(Surface& s, const Goal& goal);

/// The simplified mesh and the fates of its attributes.
Mesh finished(Surface& s, const Mesh& from, Fates& fates);

} // namespace facetmill::simplification

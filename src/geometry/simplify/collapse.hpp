#pragma once
// One edge collapse, and the state that a worker needs around it.

#include "geometry/simplify/cost.hpp"
#include "geometry/simplify/fan_bounds.hpp"

namespace facetmill::simplification {

/// A corner at a vertex, with the next and the previous vertex of its face.
struct RingCorner {
    Index corner, next, before;
    bool has(Index v) const { return next == v || before == v; }
};

/// The live faces at a vertex.
struct Ring {
    /// Vertices with more faces wait until other collapses have removed some.
    static constexpr std::size_t max_size = 256;
    std::array<RingCorner, max_size> corners;
    std::size_t size = 0;

    const RingCorner* begin() const { return corners.data(); }
    const RingCorner* end() const { return corners.data() + size; }
};

/// A face on the edge: its corners at both ends, and the opposite vertex.
struct Side {
    Index at_a, at_b, opposite;
};

/// Two back-to-back faces: their corners and their other two vertices.
struct Cancelled {
    Index at_a, at_b, from, to;
};

/// The vertices that a worker may touch: one or two chunks of the curve, or all vertices.
struct Territory {
    Index size = none;           ///< number of vertices in a chunk
    Index first = 0, second = 0; ///< the lowest vertices of the chunks

    bool has(Index v) const { return v - first < size || v - second < size; }
};

/// The surroundings of an edge from a to b, where b merges into a. Reused, so that no edge allocates memory.
struct Around {
    /// Faces on a collapsing edge. There can be more than two only if topology changes are allowed.
    static constexpr int max_sides = 4;

    Territory territory;
    Index a = none, b = none;
    Ring at_a, at_b;
    std::array<Side, max_sides> side{};
    int sides = 0; ///< may exceed max_sides: then the edge stays

    // Used only if topology may change.
    bool waits = false; ///< postpones topology changes
    bool changes_topology = false;
    std::array<Cancelled, max_sides> cancelled{};
    int cancellations = 0;

    // Used only for max_error, see bounds.cpp.
    std::vector<RingCorner> staying; ///< the corner at a or b of each surviving face around the edge
    std::vector<Index> points;       ///< points of the faces around the edge
    std::vector<Index> taken_by;     ///< [points] index into staying of the face that takes the point
    FanBounds bounds;                ///< distances of points to the faces of staying
};

/// Collapses made by one worker; added to the state's totals afterwards.
struct Tally {
    std::size_t collapses = 0, faces = 0, vertices = 0; ///< removed faces and vertices
    double largest = 0;                                 ///< largest error squared, in the frame
    Collapses log;
};

enum class Attempt {
    done,
    refused, ///< the collapse would break a guarantee: the edge is blocked, and its flags give the reason
    outside, ///< something around the edge is outside the territory: no change
    later,   ///< the collapse would change the topology and is postponed: no change
};
/// Collapses the edge of corner c if all guarantees hold, and updates the cost of every changed edge. around:
/// scratch memory that also holds the territory.
[[nodiscard]] Attempt collapse(State& s, Index c, Around& around, Pricer& pricer, Tally& tally);

} // namespace facetmill::simplification

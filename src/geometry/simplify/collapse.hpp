#pragma once
// One collapse, and what a worker knows around it.

#include "geometry/simplify/cost.hpp"
#include "geometry/simplify/fan_bounds.hpp"

namespace facetmill::simplification {

/// A corner at a vertex, and where its face leads on to and comes from.
struct RingCorner {
    Index corner, next, before;
    bool has(Index v) const { return next == v || before == v; }
};

/// The live faces at a vertex.
struct Ring {
    /// Vertices with more wait until others have thinned them out.
    static constexpr std::size_t max_size = 256;
    std::array<RingCorner, max_size> corners;
    std::size_t size = 0;

    const RingCorner* begin() const { return corners.data(); }
    const RingCorner* end() const { return corners.data() + size; }
};

/// A face on the edge: its corners at the two ends, and the vertex across.
struct Side {
    Index at_a, at_b, opposite;
};

/// Two faces that lie back to back: their corners, and the other two vertices.
struct Cancelled {
    Index at_a, at_b, from, to;
};

/// The vertices that a worker may touch: those of one or two stretches of the curve, or all.
struct Territory {
    Index size = none;           ///< of a stretch
    Index first = 0, second = 0; ///< the lowest vertices of the stretches

    bool has(Index v) const { return v - first < size || v - second < size; }
};

/// The surroundings of an edge from a to b, which goes into a; reused, so that nothing is allocated per edge.
struct Around {
    /// Faces on an edge that goes; more than two only where topology was allowed to go.
    static constexpr int max_sides = 4;

    Territory territory;
    Index a = none, b = none;
    Ring at_a, at_b;
    std::array<Side, max_sides> side{};
    int sides = 0; ///< may be above max_sides: then the edge stays

    // Only where topology may change.
    bool waits = false; ///< what changes it is left for later
    bool changes_topology = false;
    std::array<Cancelled, max_sides> cancelled{};
    int cancellations = 0;

    // Only for max_error, see bounds.cpp.
    std::vector<RingCorner> staying; ///< at a or b, of each face around that stays
    std::vector<Index> points;       ///< of the faces around the edge
    std::vector<Index> taken_by;     ///< [points] which of staying takes it
    FanBounds bounds;                ///< of the distances of points to the faces of staying
};

/// Collapses that one worker makes; joined into the state's totals afterwards.
struct Tally {
    std::size_t collapses = 0, faces = 0, vertices = 0; ///< faces and vertices that went
    double largest = 0;                                 ///< largest error squared, in the frame
    Collapses log;
};

enum class Attempt {
    done,
    refused, ///< it would break a guarantee: the edge is blocked and its flags say why
    outside, ///< something around the edge is beyond the territory: nothing was done
    later,   ///< it changes the topology and waits: nothing was done
};
/// Collapses the edge of corner c if all guarantees hold, and prices the edges that changed. around: scratch,
/// with the territory.
Attempt collapse(State& s, Index c, Around& around, Pricer& pricer, Tally& tally);

} // namespace facetmill::simplification

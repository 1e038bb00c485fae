#pragma once
// What a worker finds around an edge that is to be collapsed. Only simplify_*.cpp of the collapse include
// this.

#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

/// A corner at a vertex, and where its face leads on to and comes from.
struct Spoke {
    Index corner, next, before;
    bool has(Index v) const { return next == v || before == v; }
};

/// The live faces at a vertex.
struct Ring {
    static constexpr std::size_t most = 256; ///< vertices with more wait until others have thinned them out
    std::array<Spoke, most> spokes;
    std::size_t size = 0;

    const Spoke* begin() const { return spokes.data(); }
    const Spoke* end() const { return spokes.data() + size; }
};

/// A face on the edge: its corners at the two ends, and the vertex across.
struct Side {
    Index at_a, at_b, opposite;
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
    static constexpr int most_sides = 4;

    Territory territory;
    Index a = none, b = none;
    Ring at_a, at_b;
    std::array<Side, most_sides> side{};
    int sides = 0; ///< may be above most_sides: then the edge stays

    // Only where topology may change (simplify_topology.cpp).
    struct Cancelled {
        Index at_a, at_b, from,
            to; ///< two faces that lie back to back: their corners, and the other two vertices
    };
    bool changes_topology = false;
    std::array<Cancelled, most_sides> cancelled{};
    int cancellations = 0;

    // Only for max_error (simplify_points.cpp).
    std::vector<Spoke> staying;     ///< at a or b, of each face around that stays
    std::vector<Index> points;      ///< of the faces around the edge
    std::vector<Index> taken_by;    ///< [points] which of staying takes it
    std::vector<Vec3> places;       ///< the new vertex, and some on the faces that stay
    std::vector<std::uint8_t> near; ///< [places] known to be near the surface that came in
};

/// Finds the face that takes each point of the faces around; false when one would be farther from all than
/// `most`, squared, or the new faces farther from the surface that came in.
bool points_stay_near(const Work& s, Around& around, const Vec3& to, double most);
/// Gives each point to the face that points_stay_near found.
void hand_over_points(Work& s, const Around& around);

/// Finds the faces that would lie back to back, which go both; false when the collapse would double a face,
/// take a corner's last one, or leave points with nowhere to go.
bool find_cancelled(const Work& s, Around& around);
/// Whether no face at either end would be left.
bool vanishes(const Work& s, const Around& around);
/// After the edit: takes away the faces that lie back to back, tells closed holes and vertices that have no
/// face any more. faces: that went already. Returns all faces and vertices that went.
std::pair<std::size_t, std::size_t> settle_topology(Work& s, const Around& around, std::size_t faces);

/// Takes a face out, with the costs of its edges.
inline void kill_face(Work& s, Index f) {
    s.tri[3 * f] = none;
    for (Index c = 3 * f; c < 3 * f + 3; ++c) s.cost[c] = never;
}

} // namespace facetmill::simplification

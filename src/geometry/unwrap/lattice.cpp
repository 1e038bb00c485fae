#include "geometry/unwrap/lattice.hpp"

#include "geometry/unwrap/untangle.hpp"

namespace facetmill::unwrap_room {

namespace {

constexpr int sweeps_of_lattice = 16;
constexpr int farthest = 3; // steps

/// Products of coordinates below 2^24 are exact in doubles.
double doubled_area(const std::vector<Index>& corners, const std::vector<Vec2>& p, std::size_t f) {
    const Vec2& a = p[corners[3 * f]];
    return cross(p[corners[3 * f + 1]] - a, p[corners[3 * f + 2]] - a);
}

std::vector<Index> flipped_faces(const std::vector<Index>& corners, const std::vector<Vec2>& points) {
    std::vector<Index> list;
    for (std::size_t f = 0; 3 * f < corners.size(); ++f)
        if (!(doubled_area(corners, points, f) > 0)) list.push_back(static_cast<Index>(f));
    return list;
}

/// Moves a point to the place near its home where its smallest triangle is largest.
void nudge(const std::vector<Index>& corners, const VertexLists& around, Index p, const Vec2& home,
           std::vector<Vec2>& points) {
    const auto worst = [&] {
        double least = HUGE_VAL;
        for (const Index f : around.of(p)) least = std::min(least, doubled_area(corners, points, f));
        return least;
    };
    Vec2 best = points[p];
    double most = worst();
    for (int dy = -farthest; dy <= farthest; ++dy)
        for (int dx = -farthest; dx <= farthest; ++dx) {
            points[p] = home + Vec2{static_cast<double>(dx), static_cast<double>(dy)};
            if (const double w = worst(); w > most) {
                most = w;
                best = points[p];
            }
        }
    points[p] = best;
}

} // namespace

bool round_to_lattice(const std::vector<Index>& corners, const std::vector<BorderEdge>& border,
                      std::vector<Vec2>& points) {
    for (Vec2& p : points) p = {std::floor(p.x + 0.5), std::floor(p.y + 0.5)};
    const std::vector<Vec2> homes = points; // sweeps must not add up, or charts could meet
    VertexLists around;
    for (int sweep = 0; sweep < sweeps_of_lattice; ++sweep) {
        const std::vector<Index> flipped = flipped_faces(corners, points);
        if (flipped.empty()) break;
        if (around.offsets.empty()) around = triangles_around(corners, points.size());
        for (const Index f : flipped)
            for (std::size_t i = 0; i < 3; ++i) {
                const Index p = corners[3 * f + i];
                nudge(corners, around, p, homes[p], points);
            }
    }
    return all_turn_left(corners, points) && is_simple_border(border, points);
}

} // namespace facetmill::unwrap_room

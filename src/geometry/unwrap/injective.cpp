// Exact tests that a flat chart covers no point twice.
#include "base/math/predicates.hpp"
#include "geometry/unwrap/chart.hpp"

#include <numeric>

namespace facetmill::unwrap_room {

namespace {

int turn(const Vec2& a, const Vec2& b, const Vec2& c) { return orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y); }

/// Whether two segments without a common point have a common place.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const int abc = turn(a, b, c), abd = turn(a, b, d);
    if (abc * abd > 0) return false;
    const int cda = turn(c, d, a), cdb = turn(c, d, b);
    if (cda * cdb > 0) return false;
    if (abc != 0 || abd != 0) return true;
    const auto [x0, x1] = std::minmax({a.x, b.x});
    const auto [y0, y1] = std::minmax({a.y, b.y});
    return std::max(c.x, d.x) >= x0 && std::min(c.x, d.x) <= x1 && std::max(c.y, d.y) >= y0 &&
           std::min(c.y, d.y) <= y1;
}

/// Whether segments from a common point run along each other.
bool folds_back(const Vec2& common, const Vec2& a, const Vec2& b) {
    return turn(common, a, b) == 0 && dot(a - common, b - common) > 0;
}

bool edges_meet(const BorderEdge& e, const BorderEdge& f, const std::vector<Vec2>& p) {
    if (e.from == f.to && e.to == f.from) return true;
    if (e.to == f.from) return folds_back(p[e.to], p[e.from], p[f.to]);
    if (f.to == e.from) return folds_back(p[e.from], p[f.from], p[e.to]);
    return segments_meet(p[e.from], p[e.to], p[f.from], p[f.to]);
}

/// Whether exactly one loop of the border runs anticlockwise.
bool has_one_outer_loop(const std::vector<BorderEdge>& border, const std::vector<Vec2>& points) {
    std::vector<Index> leaving(points.size(), none);
    for (Index i = 0; i < border.size(); ++i) {
        if (leaving[border[i].from] != none) return false;
        leaving[border[i].from] = i;
    }
    std::vector<std::uint8_t> seen(border.size());
    std::size_t outer = 0;
    std::vector<Vec2> loop;
    for (Index first = 0; first < border.size(); ++first) {
        loop.clear();
        for (Index i = first; i != none && !seen[i]; i = leaving[border[i].to]) {
            seen[i] = 1;
            loop.push_back(points[border[i].from]);
        }
        if (!loop.empty()) outer += polygon::orientation(loop) > 0;
    }
    return outer == 1;
}

} // namespace

bool all_turn_left(const std::vector<Index>& corners, const std::vector<Vec2>& points) {
    for (std::size_t c = 0; c < corners.size(); c += 3)
        if (turn(points[corners[c]], points[corners[c + 1]], points[corners[c + 2]]) <= 0) return false;
    return true;
}

bool is_simple_border(const std::vector<BorderEdge>& border, const std::vector<Vec2>& points) {
    if (border.size() == 3) return true; // a triangle that turns left
    Box box;
    for (const BorderEdge& e : border) box.add(Vec3{points[e.from].x, points[e.from].y, 0});
    const bool along_x = box.extent().x >= box.extent().y;
    // Sweeps along the longer side of the box.
    const auto low = [&](const BorderEdge& e, bool x) {
        return x ? std::min(points[e.from].x, points[e.to].x) : std::min(points[e.from].y, points[e.to].y);
    };
    const auto high = [&](const BorderEdge& e, bool x) {
        return x ? std::max(points[e.from].x, points[e.to].x) : std::max(points[e.from].y, points[e.to].y);
    };
    std::vector<Index> order(border.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        const double l = low(border[a], along_x), m = low(border[b], along_x);
        return l != m ? l < m : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const BorderEdge& e = border[order[i]];
        const double end = high(e, along_x), below = low(e, !along_x), above = high(e, !along_x);
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const BorderEdge& f = border[order[j]];
            if (low(f, along_x) > end) break;
            if (low(f, !along_x) <= above && high(f, !along_x) >= below && edges_meet(e, f, points))
                return false;
        }
    }
    return has_one_outer_loop(border, points);
}

} // namespace facetmill::unwrap_room

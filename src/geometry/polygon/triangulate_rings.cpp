#include "geometry/polygon/triangulate_rings.hpp"

#include "base/math/predicates.hpp"

#include <algorithm>

namespace facetmill::polygon {

namespace {

Contours contours_of(Rings rings) {
    Contours contours;
    for (const Ring ring : rings) {
        const auto first = static_cast<Index>(contours.points.size()), n = static_cast<Index>(ring.size());
        contours.points.insert(contours.points.end(), ring.begin(), ring.end());
        for (Index i = 0; i < n; ++i) contours.edges.push_back({first + i, first + (i + 1) % n, 1});
    }
    return contours;
}

/// Makes a triangle anticlockwise, with its lowest corner first. True if it was clockwise.
bool turn_left(std::array<Index, 3>& t, const std::vector<Vec2>& points) {
    const Vec2 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const bool clockwise = orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y) < 0;
    if (clockwise) std::swap(t[1], t[2]);
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return clockwise;
}

} // namespace

Triangulation triangulate_rings(Rings rings) { return triangulate_contours(contours_of(rings)); }

Triangulation triangulate_contours(const Contours& contours) {
    const Filling filling = fill(contours);
    std::vector<Vec2> points = contours.points;
    Triangulation out;
    for (const auto& a : filling.added) {
        out.added.push_back({a.at, a.edge, a.t});
        points.push_back(a.at);
    }
    struct Counted {
        std::array<Index, 3> triangle;
        int winding;
    };
    std::vector<Counted> all;
    for (auto t : filling.triangles) {
        const bool clockwise = turn_left(t, points);
        all.push_back({t, clockwise ? -1 : 1});
    }
    std::sort(all.begin(), all.end(),
              [](const Counted& a, const Counted& b) { return a.triangle < b.triangle; });
    for (const Counted& c : all) {
        if (!out.triangles.empty() && out.triangles.back() == c.triangle) {
            out.winding.back() += c.winding;
        } else {
            out.triangles.push_back(c.triangle);
            out.winding.push_back(c.winding);
        }
    }
    return out;
}

WindingRange winding_range(Rings rings) {
    WindingRange range;
    for (const int w : triangulate_rings(rings).winding) {
        range.min = std::min(range.min, w);
        range.max = std::max(range.max, w);
    }
    return range;
}

std::optional<Moments> moments_by_winding(Ring ring) {
    const Triangulation t = triangulate_rings(Rings(&ring, 1));
    const auto at = [&](Index i) { return i < ring.size() ? ring[i] : t.added[i - ring.size()].at; };
    std::vector<std::array<Vec2, 3>> triangles;
    for (const auto& abc : t.triangles) triangles.push_back({at(abc[0]), at(abc[1]), at(abc[2])});
    const std::vector<Ring> rings(triangles.begin(), triangles.end());
    return moments(rings);
}

} // namespace facetmill::polygon

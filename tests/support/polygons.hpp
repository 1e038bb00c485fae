#pragma once
// Small named polygons for tests.

#include "geometry/polygon/triangulate_rings.hpp"

#include <algorithm>
#include <deque>
#include <vector>

namespace facetmill::test {

inline std::vector<Vec2> square(double x, double y, double side) {
    return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}
inline std::vector<Vec2> reversed(std::vector<Vec2> ring) {
    std::reverse(ring.begin(), ring.end());
    return ring;
}
inline std::vector<Vec2> moved(std::vector<Vec2> ring, Vec2 by) {
    for (auto& p : ring) p = p + by;
    return ring;
}
/// An L of three unit squares, without the upper right square: area 3, centroid 5/6, 5/6.
inline std::vector<Vec2> l_shape() { return {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}; }
inline std::vector<Vec2> regular(int n, double radius) {
    std::vector<Vec2> ring;
    for (int i = 0; i < n; ++i)
        ring.push_back({radius * std::cos(2 * M_PI * i / n), radius * std::sin(2 * M_PI * i / n)});
    return ring;
}
inline std::vector<Vec2> pentagram() {
    const auto p = regular(5, 1);
    return {p[0], p[2], p[4], p[1], p[3]};
}
inline std::vector<Vec2> figure_eight() { return {{0, 0}, {2, 2}, {2, 0}, {0, 2}}; }
/// A square of side 4 with a square hole of side 2, bridged by coincident edges; area 12.
inline std::vector<Vec2> keyhole() {
    return {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
}

/// Rings over vectors that stay alive with the object.
class RingList {
  public:
    explicit RingList(std::vector<std::vector<Vec2>> rings) : points_(std::move(rings)) {
        for (const auto& p : points_) rings_.push_back(p);
    }
    operator polygon::Rings() const { return rings_; }

  private:
    std::vector<std::vector<Vec2>> points_;
    std::vector<polygon::Ring> rings_;
};
inline RingList rings_of(std::vector<std::vector<Vec2>> rings) { return RingList(std::move(rings)); }

/// The sum of the triangles' areas times their windings.
inline double sum_of(const polygon::Triangulation& t, const std::vector<std::vector<Vec2>>& rings) {
    std::vector<Vec2> points;
    for (const auto& ring : rings) points.insert(points.end(), ring.begin(), ring.end());
    for (const auto& a : t.added) points.push_back(a.at);
    double sum = 0;
    for (std::size_t i = 0; i < t.triangles.size(); ++i) {
        const Vec2 a = points[t.triangles[i][0]], b = points[t.triangles[i][1]],
                   c = points[t.triangles[i][2]];
        sum += cross(b - a, c - a) / 2 * t.winding[i];
    }
    return sum;
}

} // namespace facetmill::test

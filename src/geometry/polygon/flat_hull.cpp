#include "geometry/polygon/flat_hull.hpp"

#include "base/math/predicates.hpp"

#include <algorithm>
#include <tuple>

namespace facetmill {

std::vector<FlatPoint> flat_hull(std::vector<FlatPoint> points) {
    std::sort(points.begin(), points.end(),
              [](const FlatPoint& a, const FlatPoint& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
    std::vector<FlatPoint> ring;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t before = ring.size();
        for (const FlatPoint& p : points) {
            while (ring.size() >= before + 2) {
                const FlatPoint &a = ring[ring.size() - 2], &b = ring.back();
                if (orientation_2d(a.x, a.y, b.x, b.y, p.x, p.y) > 0) break;
                ring.pop_back();
            }
            ring.push_back(p);
        }
        ring.pop_back(); // it begins the next pass
        std::reverse(points.begin(), points.end());
    }
    return ring;
}

} // namespace facetmill

#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/simplify/fan_bounds.hpp"
#include "geometry/spatial/closest_point.hpp"

using namespace facetmill;
using simplification::FanBounds;

TEST_CASE("bounds of a fan are below the distances, and near most of them", "[geometry]") {
    FanBounds bounds;
    std::size_t near = 0, all = 0;
    for (std::uint64_t k = 0; k < 400; ++k) {
        const double size = std::pow(10.0, static_cast<double>(k % 25) - 12);
        const Vec3 centre = test::random_point(1, 3, k) * (k % 2 == 0 ? 0 : 1);
        std::vector<Vec3> points, ring;
        for (std::uint64_t i = 0; i < 1 + k % 30; ++i)
            points.push_back(centre + test::random_point(size, 4, 100 * k + i));
        for (std::uint64_t i = 0; i < 6; ++i) {
            const double width = i == 5 ? 1e-7 : i == 4 ? 0 : k % 3 == 0 ? 100 : 1; // slivers, large ones
            ring.push_back(centre + test::random_point(size, 5, 100 * k + i));
            ring.push_back(ring.back() + test::random_point(size, 6, 100 * k + i) * width);
        }
        bounds.begin(centre, points);
        for (std::size_t t = 0; t < 6; ++t) bounds.add(ring[2 * t], ring[2 * t + 1]);
        for (std::size_t t = 0; t < 6; ++t)
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Vec3 off =
                    points[i] - closest_on_triangle(points[i], centre, ring[2 * t], ring[2 * t + 1]);
                const double square = dot(off, off), bound = bounds.square(t, i);
                REQUIRE(std::sqrt(bound) <=
                        std::sqrt(square) + 1e-15 * length(points[i])); // it is rounded there
                ++all;
                near += bound > 0.5 * square;
            }
    }
    CHECK(near > all / 3);
}

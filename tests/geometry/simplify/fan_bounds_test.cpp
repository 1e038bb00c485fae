#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "geometry/simplify/fan_bounds.hpp"
#include "geometry/spatial/closest_point.hpp"

using namespace facetmill;
using simplification::FanBounds;

namespace {

/// Triangles around a vertex: well shaped or large; in every other fan one is flat, and one nearly so.
struct Fan {
    Vec3 centre;
    std::vector<Vec3> ring, points; // two of ring for each triangle
    double reach = 0;

    explicit Fan(std::uint64_t k) {
        const double size = std::pow(10.0, static_cast<double>(k % 25) - 12);
        centre = test::random_point(1, 3, k) * (k % 2 == 0 ? 0 : 1);
        for (std::uint64_t i = 0; i < 1 + k % 4; ++i)
            points.push_back(centre + test::random_point(size, 4, 100 * k + i));
        for (std::uint64_t i = 0; i < 6; ++i) {
            const bool sliver = i >= 4 && k / 4 % 2 == 0;
            const double width = sliver ? (i == 5 ? 1e-7 : 0) : k % 3 == 0 ? 100 : 1;
            ring.push_back(centre + test::random_point(size, 5, 100 * k + i));
            ring.push_back(ring.back() + test::random_point(size, 6, 100 * k + i) * width);
        }
        for (const auto* list : {&points, &ring})
            for (const Vec3& p : *list) reach = std::max(reach, length(p - centre));
    }
    double distance(std::size_t triangle, std::size_t point) const {
        const Vec3& p = points[point];
        return length(p - closest_on_triangle(p, centre, ring[2 * triangle], ring[2 * triangle + 1]));
    }
    double rounding(std::size_t point) const { return 1e-15 * length(points[point]); }

    void lay(FanBounds& bounds, double near) const {
        bounds.begin(centre, reach, near);
        for (std::size_t t = 0; t < 6; ++t) bounds.add(ring[2 * t], ring[2 * t + 1]);
        bounds.look(points);
    }
};

} // namespace

TEST_CASE("bounds of a fan are below the distances, and near most of them", "[geometry]") {
    FanBounds bounds;
    std::size_t near = 0, all = 0, known = 0, points = 0;
    for (std::uint64_t k = 0; k < 1600; ++k) {
        const Fan fan(k);
        fan.lay(bounds, fan.reach);
        for (std::size_t i = 0; i < fan.points.size(); ++i) {
            const auto nearest = static_cast<std::size_t>(bounds.nearest(i));
            REQUIRE(nearest < 6);
            for (std::size_t t = 0; t < 6; ++t) {
                const double distance = fan.distance(t, i), bound = bounds.square(t, i);
                REQUIRE(std::sqrt(bound) <= distance + fan.rounding(i));
                REQUIRE(bounds.square(nearest, i) <= bound);
                ++all;
                near += bound > 0.5 * distance * distance;
            }
            REQUIRE(std::sqrt(bounds.most(i)) >= fan.distance(nearest, i) - fan.rounding(i));
            known += bounds.most(i) < HUGE_VAL;
            ++points;
        }
    }
    CHECK(near > all / 3);
    CHECK(known > points / 50);
}

TEST_CASE("places on a fan that are noted as near are near a point", "[geometry]") {
    FanBounds bounds;
    std::size_t found = 0, missed = 0;
    for (std::uint64_t k = 0; k < 400; ++k) {
        const Fan fan(k);
        const double limit = fan.reach / 4;
        fan.lay(bounds, limit);
        for (std::size_t t = 0; t < 6; ++t) {
            for (std::size_t i = 0; i < fan.points.size(); ++i) bounds.note_near(t, i);
            for (std::size_t place = 0; place < 8; ++place) {
                const double b = FanBounds::weight_b[place], c = FanBounds::weight_c[place];
                const Vec3 at = fan.centre * (1 - b - c) + fan.ring[2 * t] * b + fan.ring[2 * t + 1] * c;
                double least = HUGE_VAL;
                for (const Vec3& p : fan.points) least = std::min(least, length(p - at));
                const bool near = (bounds.near(t) >> place & 1) != 0;
                if (near) REQUIRE(least <= limit);
                found += near;
                missed += !near && least < 0.999 * limit;
            }
        }
    }
    CHECK(found > 100);
    CHECK(missed == 0);
}

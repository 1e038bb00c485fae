#include "support/catch.hpp"

#include "base/math/random.hpp"
#include "geometry/deviation/area_samples.hpp"
#include "geometry/deviation/deviation.hpp"
#include "mesh/shapes.hpp"
#include "support/meshes.hpp"

using namespace facetmill;

namespace {

std::vector<Surface> sampled_surfaces() {
    Mesh holes = test::noisy_icosphere(3, 0.05, 3); // some triangles have no area, and some have no position
    for (Index c = 30; c < 90; c += 3) holes.corners[c] = holes.corners[c + 1];
    holes.positions[5].x = std::nan("");
    holes.corners.insert(holes.corners.end(), {1, 1, 2}); // including the last
    return {surface_of(shapes::grid(1, 1)), surface_of(test::noisy_icosphere(5, 0.1, 1)),
            surface_of(test::random_triangles(300, 0.5, 2)), surface_of(holes)};
}

} // namespace

TEST_CASE("the k-th sample lies in the k-th of equal parts of the area", "[geometry]") {
    for (const Surface& surface : sampled_surfaces())
        for (const std::size_t count : {1, 7, 1000, 40000}) {
            const AreaSamples samples(surface, count, 5);
            REQUIRE(samples.size() == count);
            double all = 0;
            std::vector<double> areas;
            for (std::size_t t = 0; t < surface.size(); ++t) {
                const Vec3& a = surface.point(t, 0);
                const double area = length(cross(surface.point(t, 1) - a, surface.point(t, 2) - a)) / 2;
                areas.push_back(std::isfinite(area) ? area : 0);
                all += areas.back();
            }
            double before = 0;
            std::size_t k = 0;
            for (std::size_t t = 0; t < surface.size(); ++t) {
                const double after = before + areas[t], slack = 1e-9 * all;
                for (; k < count && samples.triangle_of(k) == t; ++k) {
                    const double part = all / static_cast<double>(count),
                                 begin = static_cast<double>(k) * part;
                    REQUIRE(before < begin + part + slack);
                    REQUIRE(after > begin - slack);
                    REQUIRE(areas[t] > 0);
                }
                before = after;
            }
            CHECK(k == count); // so they ascend
        }
}

TEST_CASE("runs have all samples, triangle by triangle in the order that is asked for", "[geometry]") {
    for (const Surface& surface : sampled_surfaces())
        for (const std::size_t count : {1, 70, 40000}) {
            const AreaSamples samples(surface, count, 5);
            std::vector<Index> order(surface.size());
            for (std::size_t t = 0; t < order.size(); ++t)
                order[t] = static_cast<Index>(order.size() - 1 - t);
            std::size_t found = 0, last = order.size();
            for (const AreaSamples::Run& run : samples.runs(order)) {
                REQUIRE(run.triangle < last);
                last = run.triangle;
                REQUIRE(run.begin < run.end);
                for (std::size_t k = run.begin; k < run.end; ++k)
                    REQUIRE(samples.triangle_of(k) == run.triangle);
                found += run.end - run.begin;
            }
            CHECK(found == count);
        }
}

TEST_CASE("a sample by itself is the one of all, on its triangle", "[geometry]") {
    for (const Surface& surface : sampled_surfaces()) {
        const AreaSamples samples(surface, 3000, 7);
        const auto all = sample_area(surface, 3000, 7);
        REQUIRE(all.size() == 3000);
        for (std::size_t k = 0; k < all.size(); k += 17) {
            const std::size_t t = all[k].triangle;
            REQUIRE(samples.triangle_of(k) == t);
            REQUIRE(samples.point(k) == all[k].point);
            const Vec3 &a = surface.point(t, 0), &b = surface.point(t, 1), &c = surface.point(t, 2);
            const Vec3 n = cross(b - a, c - a), p = all[k].point;
            const double slack = -1e-9 * dot(n, n);
            REQUIRE(dot(cross(b - a, p - a), n) >= slack);
            REQUIRE(dot(cross(c - b, p - b), n) >= slack);
            REQUIRE(dot(cross(a - c, p - c), n) >= slack);
        }
    }
}

TEST_CASE("a surface without an area has no samples", "[geometry]") {
    Mesh flat = shapes::cube();
    for (Vec3& p : flat.positions) p = {1, 2, 3};
    CHECK(AreaSamples(surface_of(flat), 100, 1).size() == 0);
    CHECK(AreaSamples(Surface{}, 100, 1).size() == 0);
    CHECK(sample_area(surface_of(flat), 100, 1).empty());
}

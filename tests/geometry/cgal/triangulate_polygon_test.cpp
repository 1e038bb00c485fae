#include "geometry/cgal/triangulate_polygon.hpp"

#include "base/math/random.hpp"
#include "support/catch.hpp"

#include <map>

using namespace facetmill;

namespace {

/// A closed contour through the points from first on.
void add_loop(Contours& contours, std::vector<Vec2> points) {
    const auto first = static_cast<Index>(contours.points.size()), n = static_cast<Index>(points.size());
    contours.points.insert(contours.points.end(), points.begin(), points.end());
    for (Index i = 0; i < n; ++i) contours.edges.push_back({first + i, first + (i + 1) % n, 1});
}

double area(const Contours& contours, const Filling& filling) {
    const auto at = [&](Index i) {
        return i < contours.points.size() ? contours.points[i] : filling.added[i - contours.points.size()].at;
    };
    double twice = 0;
    for (const auto& [a, b, c] : filling.triangles)
        twice += (at(b).x - at(a).x) * (at(c).y - at(a).y) - (at(c).x - at(a).x) * (at(b).y - at(a).y);
    return twice / 2;
}

/// Whether the triangles' boundary is the edges along their paths.
bool bounded_by_contours(const Contours& contours, const Filling& filling) {
    std::map<std::pair<Index, Index>, int> left;
    const auto add = [&](Index a, Index b, int count) {
        if (a != b) left[{std::min(a, b), std::max(a, b)}] += a < b ? count : -count;
    };
    for (const auto& t : filling.triangles)
        for (std::size_t k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3], 1);
    for (std::size_t e = 0; e < contours.edges.size(); ++e) {
        Index last = filling.same[contours.edges[e].from];
        for (Index k = filling.path_offsets[e]; k < filling.path_offsets[e + 1]; ++k) {
            add(last, filling.path[k], -contours.edges[e].count);
            last = filling.path[k];
        }
        add(last, filling.same[contours.edges[e].to], -contours.edges[e].count);
    }
    for (const auto& [edge, count] : left)
        if (count != 0) return false;
    return true;
}

} // namespace

TEST_CASE("a square is filled counter-clockwise, and reversed when it turns clockwise", "[geometry]") {
    Contours square;
    add_loop(square, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    const Filling filling = fill(square);
    CHECK(filling.triangles.size() == 2);
    CHECK(area(square, filling) == 1);
    for (auto& e : square.edges) e.count = -1;
    CHECK(area(square, fill(square)) == -1);
    CHECK(bounded_by_contours(square, fill(square)));
}

TEST_CASE("holes and islands nest", "[geometry]") {
    Contours contours;
    add_loop(contours, {{0, 0}, {9, 0}, {9, 9}, {0, 9}});
    add_loop(contours, {{1, 1}, {1, 8}, {8, 8}, {8, 1}});
    add_loop(contours, {{2, 2}, {7, 2}, {7, 7}, {2, 7}});
    const Filling filling = fill(contours);
    CHECK(area(contours, filling) == 81 - 49 + 25);
    CHECK(filling.added.empty());
    CHECK(bounded_by_contours(contours, filling));
}

TEST_CASE("a figure of eight is filled both ways and gets its crossing", "[geometry]") {
    Contours eight;
    add_loop(eight, {{0, 0}, {2, 2}, {2, 0}, {0, 2}});
    const Filling filling = fill(eight);
    REQUIRE(filling.added.size() == 1);
    CHECK(filling.added[0].at == Vec2{1, 1});
    CHECK(filling.added[0].t == 0.5);
    CHECK(area(eight, filling) == 0);
    CHECK(filling.triangles.size() == 2);
    CHECK(bounded_by_contours(eight, filling));
}

TEST_CASE("what is surrounded twice is filled twice", "[geometry]") {
    Contours contours;
    add_loop(contours, {{0, 0}, {3, 0}, {3, 3}, {0, 3}});
    add_loop(contours, {{1, 1}, {5, 1}, {5, 2}, {1, 2}});
    const Filling filling = fill(contours);
    CHECK(filling.added.size() == 2);
    CHECK(area(contours, filling) == Approx(9 + 4));
    CHECK(bounded_by_contours(contours, filling));
}

TEST_CASE("contours that share points, edges and stretches of edges", "[geometry]") {
    Contours contours;
    add_loop(contours, {{0, 0}, {4, 0}, {4, 4}, {0, 4}});
    add_loop(contours, {{1, 4}, {3, 4}, {3, 6}, {1, 6}});
    add_loop(contours, {{4, 0}, {8, 0}, {8, 4}, {4, 4}});
    const Filling filling = fill(contours);
    CHECK(area(contours, filling) == 16 + 4 + 16);
    CHECK(filling.path.size() == 2);
    CHECK(bounded_by_contours(contours, filling));
}

TEST_CASE("contours without area are bounded by nothing", "[geometry]") {
    Contours line;
    add_loop(line, {{0, 0}, {2, 0}, {1, 0}});
    CHECK(bounded_by_contours(line, fill(line)));
    CHECK(fill(line).triangles.empty());
    Contours point;
    add_loop(point, {{1, 1}, {1, 1}, {1, 1}});
    CHECK(fill(point).triangles.empty());
    CHECK(fill(point).same == std::vector<Index>{0, 0, 0});
    CHECK(fill({}).triangles.empty());
}

TEST_CASE("contours that cross all over, almost in the same places, are filled exactly", "[geometry]") {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Contours contours;
        const auto number = [&](std::uint64_t key) { return uniform(hashed(seed, key)); };
        for (std::uint64_t loop = 0; loop < 12; ++loop) { // slivers through nearly one point
            const double x = number(4 * loop) - 0.5, y = number(4 * loop + 1) - 0.5,
                         off = number(4 * loop + 2) * 1e-15;
            add_loop(contours, {{-x, -y + off}, {x, y + off}, {x + 1e-15, y - off}, {-x - 1e-16, -y}});
        }
        CAPTURE(seed);
        CHECK(bounded_by_contours(contours, fill(contours)));
    }
}

TEST_CASE("edges along one line, but for rounding, keep their points between their ends", "[geometry]") {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Contours contours;
        const auto number = [&](std::uint64_t key) { return uniform(hashed(seed, key)); };
        for (std::uint64_t loop = 0; loop < 10; ++loop) { // triangles whose long sides overlap
            const double a = number(4 * loop), b = number(4 * loop + 1), off = number(4 * loop + 2) - 0.5;
            const double x = 1.2659652925814369;
            add_loop(contours,
                     {{x + (loop % 3) * 2.2e-16, a}, {x - (loop % 2) * 2.2e-16, b}, {x + off, (a + b) / 2}});
        }
        CAPTURE(seed);
        const Filling filling = fill(contours);
        CHECK(bounded_by_contours(contours, filling));
        for (std::size_t e = 0; e < contours.edges.size(); ++e) {
            const Vec2 a = contours.points[contours.edges[e].from],
                       d = contours.points[contours.edges[e].to] - a;
            for (Index k = filling.path_offsets[e]; k < filling.path_offsets[e + 1]; ++k) {
                const Index i = filling.path[k];
                const Vec2 p = i < contours.points.size() ? contours.points[i]
                                                          : filling.added[i - contours.points.size()].at;
                CHECK(dot(p - a, d) >= -1e-14 * length(d));
                CHECK(dot(p - a, d) <= dot(d, d) + 1e-14 * length(d));
                CHECK(std::fabs(cross(d, p - a)) <= 1e-14 * length(d));
            }
        }
    }
}

#include "geometry/inspect/inspect.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/meshes.hpp"

#include <algorithm>
#include <cmath>

using namespace facetmill;

namespace gap_test {

namespace {

Mesh box(const Vec3& low, const Vec3& high) {
    Mesh mesh = shapes::cube();
    for (Vec3& p : mesh.positions)
        p = {low.x + p.x * (high.x - low.x), low.y + p.y * (high.y - low.y), low.z + p.z * (high.z - low.z)};
    return mesh;
}

/// An outline, counterclockwise, raised to a height.
Mesh prism(const std::vector<std::pair<double, double>>& outline, double height) {
    Mesh mesh;
    const auto n = static_cast<Index>(outline.size());
    std::vector<Index> low, high;
    for (const double z : {0.0, height})
        for (const auto& [x, y] : outline) mesh.positions.push_back({x, y, z});
    for (Index i = 0; i < n; ++i) {
        low.insert(low.begin(), i);
        high.push_back(n + i);
    }
    add_face(mesh, low);
    add_face(mesh, high);
    for (Index i = 0; i < n; ++i) {
        const Index next = (i + 1) % n, side[4] = {i, next, n + next, n + i};
        add_face(mesh, side);
    }
    return mesh;
}

double gap_of(const Mesh& mesh) { return measure(mesh, *property_named("gap")).value_or(HUGE_VAL); }

/// The least distance along outward normals, from a grid of points of each face, to faces within 45 degrees
/// of facing it. No pair is left out, and nothing is looked up.
double sampled_gap(const Mesh& mesh, int steps) {
    double least = HUGE_VAL;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 &a = mesh.point(3 * f), &b = mesh.point(3 * f + 1), &c = mesh.point(3 * f + 2);
        const Vec3 n = normalised(cross(b - a, c - a));
        for (int i = 0; i <= steps; ++i)
            for (int j = 0; i + j <= steps; ++j) {
                const Vec3 p = a + (b - a) * (static_cast<double>(i) / steps) +
                               (c - a) * (static_cast<double>(j) / steps);
                for (Index g = 0; g < mesh.face_count(); ++g) {
                    const Vec3 &d = mesh.point(3 * g), &e = mesh.point(3 * g + 1), &h = mesh.point(3 * g + 2);
                    const Vec3 m = normalised(cross(e - d, h - d));
                    if (g == f || dot(m, n) > -std::sqrt(0.5)) continue;
                    const double t = dot(d - p, m) / dot(n, m);
                    const Vec3 q = p + n * t;
                    const bool inside = dot(cross(e - d, q - d), m) >= 0 &&
                                        dot(cross(h - e, q - e), m) >= 0 && dot(cross(d - h, q - h), m) >= 0;
                    if (inside && t > 1e-9) least = std::min(least, t);
                }
            }
    }
    return least;
}

} // namespace

TEST_CASE("gap is the distance between facing walls", "[geometry][bed]") {
    Mesh plates = box({0, 0, 0}, {5, 4, 1});
    append(plates, box({1, 1, 1.125}, {9, 9, 2}));
    CHECK(gap_of(plates) == Approx(0.125));
    CHECK(gap_of(shapes::cube()) == HUGE_VAL); // nothing faces anything
    CHECK(gap_of(shapes::icosphere(2)) == HUGE_VAL);
    // The hole of a torus: its faces are quads cut in two, so it is a little narrower than a circle.
    const double hole = gap_of(shapes::torus(96, 48, 1, 0.4));
    CHECK(hole == Approx(1.2).epsilon(0.01));
    // A hollow ball: across the cavity.
    Mesh hollow = shapes::icosphere(3), inner = shapes::icosphere(3);
    const double across = *measure(inner, *property_named("wall_thickness"));
    for (std::size_t c = 0; c < inner.corners.size(); c += 3)
        std::swap(inner.corners[c], inner.corners[c + 1]);
    for (Vec3& p : hollow.positions) p = p * 2;
    append(hollow, inner);
    CHECK(gap_of(hollow) == Approx(across));
}

TEST_CASE("gap agrees with samples of all pairs of faces", "[geometry][bed]") {
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
        Mesh two = test::noisy_icosphere(1, 0.1, seed);
        append(two, test::moved(test::noisy_icosphere(1, 0.1, seed + 10), {2.3, 0.2, -0.1}));
        const double exact = gap_of(two), sampled = sampled_gap(two, 24);
        REQUIRE(exact < HUGE_VAL);
        CHECK(exact <= sampled + 1e-12);
        CHECK(exact > sampled - 0.1); // samples are 1/24 of an edge of about 0.6 apart
    }
}

TEST_CASE("component_size finds the smallest piece", "[geometry][bed]") {
    Mesh mesh = box({0, 0, 0}, {5, 4, 1});
    append(mesh, box({7, 7, 7}, {7.1, 7.25, 7.05}));
    const double small = std::sqrt(0.1 * 0.1 + 0.25 * 0.25 + 0.05 * 0.05);
    CHECK(*measure(mesh, *property_named("component_size")) == Approx(small));
    const auto sizes = face_values(mesh, *property_named("component_size"));
    CHECK(sizes.front() == Approx(std::sqrt(42.0)));
    CHECK(sizes.back() == Approx(small));
}

TEST_CASE("detail is the width of the narrowest rib or groove", "[geometry][bed]") {
    const auto detail_of = [](const Mesh& mesh) { return *measure(mesh, *property_named("detail")); };
    // Teeth on a plate, seen from the side: ribs 0.5 wide with grooves between them.
    const auto comb = [](double rib, double groove) {
        const double left = 3 - rib, mid = 3 + groove, right = 3 + groove + rib;
        return prism({{0, 0},
                      {9, 0},
                      {9, 2},
                      {right, 2},
                      {right, 3},
                      {mid, 3},
                      {mid, 2},
                      {3, 2},
                      {3, 3},
                      {left, 3},
                      {left, 2},
                      {0, 2}},
                     4);
    };
    CHECK(detail_of(comb(0.5, 0.75)) == Approx(0.5));
    CHECK(detail_of(comb(0.75, 0.25)) == Approx(0.25));
    CHECK(detail_of(box({0, 0, 0}, {5, 4, 1})) == Approx(1)); // no groove: the wall
}

} // namespace gap_test

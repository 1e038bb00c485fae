#include "support/catch.hpp"
#include "support/meshes.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/inspect/inspect.hpp"
#include "mesh/placement.hpp"
#include "mesh/shapes.hpp"

#include <algorithm>
#include <cmath>

using namespace facetmill;

namespace wall_thickness_test {

namespace {

/// The solid of that height over an anticlockwise outline; its ends are polygons.
Mesh prism(const std::vector<std::pair<double, double>>& outline, double height) {
    Mesh mesh;
    const auto n = static_cast<Index>(outline.size());
    mesh.face_offsets.push_back(0);
    const auto end_face = [&] { mesh.face_offsets.push_back(static_cast<Index>(mesh.corners.size())); };
    for (const double z : {0.0, height})
        for (const auto& [x, y] : outline) mesh.positions.push_back({x, y, z});
    for (Index i = n; i-- > 0;) mesh.corners.push_back(i);
    end_face();
    for (Index i = 0; i < n; ++i) mesh.corners.push_back(n + i);
    end_face();
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        mesh.corners.insert(mesh.corners.end(), {i, j, n + j, n + i});
        end_face();
    }
    return mesh;
}

/// A truncated cone of height 10, as fans and quads.
Mesh frustum(double bottom, double top, int sides) {
    std::vector<std::pair<double, double>> outline;
    for (int i = 0; i < sides; ++i)
        outline.emplace_back(cosine(2 * pi * i / sides), sine(2 * pi * i / sides));
    Mesh mesh = prism(outline, 10);
    for (Vec3& p : mesh.positions) {
        const double radius = p.z == 0 ? bottom : top;
        p = {p.x * radius, p.y * radius, p.z};
    }
    return mesh;
}

double thinnest(const Mesh& mesh) {
    const auto all = face_values(mesh, *property_named("wall_thickness"));
    return *std::min_element(all.begin(), all.end());
}

} // namespace

TEST_CASE("wall_thickness finds the thin end of a wedge", "[geometry]") {
    const Mesh blunt = prism({{0, 0}, {50, 0}, {50, 5}, {0, 0.125}}, 10);
    CHECK(thinnest(blunt) == Approx(0.125));
    CHECK(thinnest(triangulated(blunt)) == Approx(0.125));
    CHECK(thinnest(prism({{0, 0}, {50, 0}, {50, 5}}, 10)) == 0); // an edge of 6 degrees
    CHECK(thinnest(prism({{0, 0}, {6, 0}, {3, 5}}, 10)) > 0.5);  // edges of about 60 degrees are corners
}

TEST_CASE("wall_thickness finds the bottoms of grooves and pits, however steep they are", "[geometry]") {
    for (const double half_width : {0.25, 1.0, 4.0}) {
        CAPTURE(half_width);
        CHECK(thinnest(prism(
                  {{0, 0}, {20, 0}, {20, 3}, {10 + half_width, 3}, {10, 0.5}, {10 - half_width, 3}, {0, 3}},
                  12)) == Approx(0.5));
    }
    Mesh pit = shapes::grid(8, 8); // over a block of height 4
    for (Vec3& p : pit.positions) p.z = p.x == 3 && p.y == 4 ? 0.75 : 4;
    CHECK(thinnest(test::solid_below(pit)) == Approx(0.75));
    // The tip of a slit is no wall.
    CHECK(thinnest(prism({{0, 0}, {20, 0}, {20, 10}, {0, 10}, {0, 5.5}, {12, 5}, {0, 4.5}}, 10)) ==
          Approx(4.5));
}

TEST_CASE("wall_thickness of plates, cones and hollow balls", "[geometry]") {
    CHECK(thinnest(prism({{0, 0}, {10, 0}, {10, 2.5}, {0, 2.5}}, 7)) == Approx(2.5));
    // Across the top rim: a ray along the normal of the side, which leans by the angle a.
    const double a = arc_tangent(1, 10);
    CHECK(thinnest(frustum(3, 2, 256)) == Approx(2 * 2 * cosine(a) / cosine(2 * a)).epsilon(1e-3));
    Mesh ball = shapes::icosphere(3);
    const double inradius = thinnest(ball) / 2;
    Mesh hollow = ball;
    for (Vec3& p : ball.positions) p = p * 0.875;
    for (std::size_t c = 0; c < ball.corners.size(); c += 3) std::swap(ball.corners[c], ball.corners[c + 1]);
    append(hollow, ball);
    CHECK(thinnest(hollow) == Approx(0.125 * inradius).epsilon(0.01));
}

TEST_CASE("the least wall thickness is the least of all faces", "[geometry]") {
    const Property& property = *property_named("wall_thickness");
    Mesh bumpy = shapes::icosphere(4);
    for (Vec3& p : bumpy.positions) p = p * (1 + 0.1 * std::fmod(std::abs(p.x * 37 + p.y * 17), 1.0));
    for (const Mesh& mesh : {bumpy, shapes::torus(40, 20), shapes::cube(), shapes::octahedron()}) {
        const std::vector<double> all = face_values(mesh, property);
        CHECK(measure(mesh, property) == *std::min_element(all.begin(), all.end())); // bit for bit
    }
    CHECK_FALSE(measure(shapes::grid(3, 3), property));
}

} // namespace wall_thickness_test

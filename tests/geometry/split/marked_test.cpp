// The methods of split that choose edges, their closures and their targets.
#include "geometry/crumple/crumple.hpp"
#include "geometry/split/split.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

#include <algorithm>

using namespace facetmill;

namespace {

SplitSettings by(SplitMethod method) {
    SplitSettings s;
    s.method = method;
    s.passes = 100;
    return s;
}

Mesh polygon_of(std::vector<Vec3> points) {
    Mesh mesh;
    mesh.positions = std::move(points);
    std::vector<Index> face;
    for (Index v = 0; v < mesh.vertex_count(); ++v) face.push_back(v);
    add_face(mesh, face);
    return mesh;
}

/// Triangles of all shapes, needles among them.
Mesh rough() {
    Mesh mesh = crumple(shapes::icosphere(3), {.amplitude = 0.03, .seed = 3}).mesh;
    for (auto& p : mesh.positions) p.z *= 0.2;
    return mesh;
}

std::vector<Index> sizes(const Mesh& mesh) {
    std::vector<Index> all;
    for (Index f = 0; f < mesh.face_count(); ++f) all.push_back(mesh.face_size(f));
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace

TEST_CASE("notch: a small triangle between the two longest edges, and a quad", "[geometry]") {
    const Mesh mesh = split(polygon_of({{0, 0, 0}, {1, 0, 0}, {0.5, 8, 0}}), {SplitMethod::notch, 1, 2}).mesh;
    CHECK(sizes(mesh) == std::vector<Index>{3, 4});
    CHECK(mesh.vertex_count() == 5);
    CHECK(std::count_if(mesh.positions.begin(), mesh.positions.end(),
                        [](const Vec3& p) { return p.y == 4; }) == 2);
}

TEST_CASE("notch: a neighbour is cut to the opposite corner", "[geometry]") {
    Mesh mesh = polygon_of({{0, 0, 0}, {1, 0, 0}, {0.5, 8, 0}});
    mesh.positions.push_back({30, 4, 0}); // its two longest edges are others than the one they share
    const Index second[] = {1, 3, 2};
    add_face(mesh, second);
    const Mesh finer = split(mesh, {SplitMethod::notch, 1, 2}).mesh;
    CHECK(sizes(finer) == std::vector<Index>{3, 3, 3, 3, 3, 4}); // the second has three marks: four triangles
    CHECK(test::count(finer).euler == 1);
}

TEST_CASE("halve: two quads through the longer pair of edges", "[geometry]") {
    const Mesh mesh =
        split(polygon_of({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}}), {SplitMethod::halve, 1, 2}).mesh;
    REQUIRE(sizes(mesh) == std::vector<Index>{4, 4});
    CHECK(mesh.positions[4] == Vec3{2, 0, 0});
    CHECK(mesh.positions[5] == Vec3{2, 1, 0});
}

TEST_CASE("halve: neighbours take the points on their edges", "[geometry]") {
    // A long quad above a tall one: the tall one has a mark more, and its neighbour to the right, a triangle,
    // one.
    Mesh mesh = polygon_of({{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {0, 1, 0}});
    for (const Vec3& p : {Vec3{0, -9, 0}, Vec3{4, -9, 0}, Vec3{7, -5, 0}}) mesh.positions.push_back(p);
    for (const auto& face : std::vector<std::vector<Index>>{{4, 5, 1, 0}, {5, 6, 1}}) add_face(mesh, face);
    const Mesh finer = split(mesh, {SplitMethod::halve, 1, 2}).mesh;
    CHECK(sizes(finer) == std::vector<Index>{3, 3, 3, 4, 4, 4, 4});
    CHECK(test::count(finer).crowded == 0);
    CHECK(test::count(finer).euler == 1);
    CHECK(test::area(finer) == Approx(test::area(mesh)));
}

TEST_CASE("bisect at the widest angle: at the foot of its bisector", "[geometry]") {
    SplitSettings s;
    s.method = SplitMethod::bisect;
    s.cut = SplitSettings::Cut::widest_angle;
    const Mesh mesh = split(polygon_of({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}), s).mesh;
    REQUIRE(mesh.face_count() == 2);
    CHECK(mesh.positions[3].x == Approx(12.0 / 7)); // both halves of the right angle are 45 degrees
    CHECK(mesh.positions[3].y == Approx(12.0 / 7));
}

TEST_CASE("bisect at the widest angle: one foot for all faces at an edge", "[geometry]") {
    SplitSettings s;
    s.method = SplitMethod::bisect;
    s.cut = SplitSettings::Cut::widest_angle;
    s.passes = 3;
    const Mesh mesh = rough(), finer = split(mesh, s).mesh;
    CHECK(test::sound(finer, 2));
    CHECK(test::volume(finer) == Approx(test::volume(mesh)).epsilon(1e-12));
}

TEST_CASE("max_edge: no edge is longer, and short ones are whole", "[geometry]") {
    const Mesh mesh = rough();
    SplitSettings s = by(SplitMethod::bisect);
    s.max_edge = facet_shape(mesh).longest_edge / 5;
    const SplitResult r = split(mesh, s);
    CHECK(facet_shape(r.mesh).longest_edge <= s.max_edge);
    CHECK(test::sound(r.mesh, 2));
    CHECK(test::volume(r.mesh) == Approx(test::volume(mesh)).epsilon(1e-12));
    CHECK(r.added == r.mesh.face_count() - mesh.face_count());
    // A mesh that already has it stays unchanged.
    CHECK(split(r.mesh, s).added == 0);
    s.method = SplitMethod::midpoint;
    CHECK(facet_shape(split(mesh, s).mesh).longest_edge <= s.max_edge);
    CHECK(split(mesh, s).mesh.face_count() == 64 * mesh.face_count());
}

TEST_CASE("max_edge is measured in world space", "[geometry]") {
    SplitSettings s = by(SplitMethod::bisect);
    s.max_edge = 3;
    CHECK(split(shapes::cube(), s).added == 0);
    for (int i = 0; i < 3; ++i) s.to_world.m[i][i] = 4;
    CHECK(split(shapes::cube(), s).added > 0);
}

TEST_CASE("the estimate for max_edge is of the right size", "[geometry]") {
    const Mesh mesh = rough();
    for (const double share : {0.5, 0.2, 0.05}) {
        SplitSettings s = by(SplitMethod::bisect);
        s.max_edge = facet_shape(mesh).longest_edge * share;
        const double estimate = split_corner_estimate(mesh, s),
                     made = static_cast<double>(split(mesh, s).mesh.corner_count());
        CHECK(made < 2 * estimate);
        CHECK(made > estimate / 2);
    }
}

TEST_CASE("a budget of faces is kept and nearly used up, the longest edges first", "[geometry]") {
    const Mesh mesh = rough();
    SplitSettings s = by(SplitMethod::bisect);
    for (const std::uint64_t faces : {1281, 1500, 3000, 20000}) {
        s.max_faces = faces;
        const SplitResult r = split(mesh, s);
        CHECK(r.mesh.face_count() <= faces);
        CHECK(r.mesh.face_count() + 40 > faces);
        CHECK(r.stop == SplitResult::Stop::budget);
        CHECK(test::sound(r.mesh, 2));
    }
    s.max_faces = 20000;
    CHECK(facet_shape(split(mesh, s).mesh).longest_edge < 0.4 * facet_shape(mesh).longest_edge);
    s.method = SplitMethod::midpoint;
    CHECK(split(mesh, s).mesh.face_count() == 4 * mesh.face_count());
    CHECK(split(mesh, s).stop == SplitResult::Stop::budget);
}

TEST_CASE("min_angle: only narrow triangles and what follows, and no angle below half the smallest",
          "[geometry]") {
    const Mesh mesh = rough();
    SplitSettings s = by(SplitMethod::bisect);
    s.min_angle = 1.01 * facet_shape(mesh).smallest_angle; // one is narrow, and of its halves one
    for (const int passes : {1, 4}) {
        s.passes = passes;
        const SplitResult r = split(mesh, s);
        CHECK(r.added > 0);
        CHECK(r.narrow <= r.narrow_before);
        CHECK(test::sound(r.mesh, 2));
        CHECK(facet_shape(r.mesh).smallest_angle >= 0.5 * facet_shape(mesh).smallest_angle - 1e-12);
    }
    s.passes = 1;
    CHECK(split(mesh, s).added < mesh.face_count());
    CHECK(split(shapes::icosphere(2), s).added == 0);
    s.method = SplitMethod::notch;
    const SplitResult r = split(mesh, s);
    CHECK(r.narrow <= r.narrow_before);
    CHECK(test::count(r.mesh).unbalanced == 0);
}

TEST_CASE("min_angle: passes end before they multiply narrow triangles", "[geometry]") {
    const Mesh mesh = rough();
    for (const auto method : {SplitMethod::bisect, SplitMethod::notch}) {
        SplitSettings s = by(method);
        s.min_angle = 0.35;
        s.passes = 10;
        const SplitResult r = split(mesh, s);
        CHECK(r.stop == SplitResult::Stop::narrow);
        CHECK(r.narrow > 0);
        CHECK(r.narrow <= r.narrow_before);
        if (r.passes == 0) CHECK(r.mesh.corners == mesh.corners);
    }
}

TEST_CASE("targets that a method cannot reach are refused", "[geometry]") {
    SplitSettings s = by(SplitMethod::centroid);
    s.max_edge = 1;
    CHECK(test::failure([&] { split(shapes::cube(), s); }) ==
          "usage [E-CONFLICT] split: centroid cannot reach the target 'max_edge' | use bisect, midpoint, "
          "quads, "
          "loop, butterfly or catmull-clark");
    s.max_edge = 0;
    s.min_angle = 1;
    CHECK(test::failure([&] { split(shapes::cube(), s); }) ==
          "usage [E-CONFLICT] split: centroid cannot reach the target 'min_angle' | use bisect or notch");
    s = by(SplitMethod::bisect);
    s.max_edge = 1e-300;
    CHECK(test::failure([&] { split(shapes::cube(), s); }).substr(0, 17) == "limit [E-LIMIT] s");
}

TEST_CASE("targets give the same for any number of threads", "[geometry]") {
    const Mesh mesh = rough();
    SplitSettings s = by(SplitMethod::bisect);
    s.max_faces = 20000;
    CHECK(test::same_for_any_threads([&] { return split(mesh, s).mesh; }));
    s.max_faces = 0;
    s.max_edge = 0.05;
    CHECK(test::same_for_any_threads([&] { return split(mesh, s).mesh; }));
}

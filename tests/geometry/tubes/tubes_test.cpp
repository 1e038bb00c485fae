#include "support/catch.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/tubes/tubes.hpp"
#include "mesh/invariants.hpp"

#include <algorithm>
#include <cmath>

using namespace facetmill;

namespace {

/// One line after the other.
Lines path(const std::vector<Vec3>& points, bool closed = false) {
    Lines lines;
    lines.points = points;
    for (Index i = 0; i + 1 < points.size(); ++i) lines.segments.push_back({i, i + 1});
    if (closed) lines.segments.push_back({static_cast<Index>(points.size() - 1), 0});
    return lines;
}

/// The area of a regular polygon.
double section_area(double thickness, int sides) {
    return sides * std::sin(2 * pi / sides) / 2 * thickness * thickness / 4;
}

void check_sound(const Mesh& mesh, std::int64_t euler) {
    CHECK(broken_invariants(mesh).empty());
    const Properties p = inspect(mesh);
    CHECK(p.closed);
    CHECK(p.edge_manifold);
    CHECK(p.vertex_manifold);
    CHECK(p.oriented);
    CHECK(p.euler == euler);
}

} // namespace

TEST_CASE("a line becomes a closed prism", "[geometry]") {
    for (const int sides : {3, 8, 31}) {
        const auto r = tubes(path({{1, 2, 3}, {3, 5, 9}}), {0.5, sides}); // of length 7
        CHECK(r.mesh.vertex_count() == static_cast<std::size_t>(2 * sides));
        CHECK(r.mesh.face_count() == static_cast<std::size_t>(sides + 2));
        CHECK((r.tubes == 1 && r.segments == 1 && r.skipped == 0 && r.sharp == 0));
        check_sound(r.mesh, 2);
        CHECK(*inspect(r.mesh).volume == Approx(7 * section_area(0.5, sides)));
    }
}

TEST_CASE("a bent line becomes one tube, mitred: as long as the line, and no thinner at its corners",
          "[geometry]") {
    const std::vector<Vec3> bent{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {2, 3, 1.5}, {0, 4, 4}};
    double length_of_all = 0;
    for (std::size_t i = 0; i + 1 < bent.size(); ++i) length_of_all += length(bent[i + 1] - bent[i]);
    const auto r = tubes(path(bent), {0.25, 12});
    CHECK((r.tubes == 1 && r.segments == 4 && r.sharp == 0));
    check_sound(r.mesh, 2);
    CHECK(*inspect(r.mesh).volume == Approx(length_of_all * section_area(0.25, 12)));
    CHECK(find_self_intersections(r.mesh).count == 0);
}

TEST_CASE("a closed line becomes a ring, planar or not", "[geometry]") {
    const auto square = tubes(path({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, true), {0.5, 8});
    check_sound(square.mesh, 0);
    CHECK(*inspect(square.mesh).volume == Approx(16 * section_area(0.5, 8)));
    CHECK_FALSE(square.mesh.all_triangles());
    // A knot whose frame returns rotated: the remaining rotation is spread along the way.
    std::vector<Vec3> knot;
    for (int i = 0; i < 200; ++i) {
        const double t = 2 * pi * i / 200;
        knot.push_back(
            {std::sin(t) + 2 * std::sin(2 * t), std::cos(t) - 2 * std::cos(2 * t), -std::sin(3 * t)});
    }
    const auto trefoil = tubes(path(knot, true), {0.4, 9});
    CHECK((trefoil.tubes == 1 && trefoil.segments == 200 && trefoil.sharp == 0));
    check_sound(trefoil.mesh, 0);
    CHECK(trefoil.mesh.all_triangles());
    CHECK(find_self_intersections(trefoil.mesh).count == 0);
    double around = 0;
    for (std::size_t i = 0; i < knot.size(); ++i) around += length(knot[(i + 1) % knot.size()] - knot[i]);
    CHECK(*inspect(trefoil.mesh).volume == Approx(around * section_area(0.4, 9)).epsilon(0.01));
}

TEST_CASE("lines follow one another whatever their order and direction, up to a fork", "[geometry]") {
    Lines lines;
    lines.points = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {3, 1, 0}, {1, 0, 0}, {3, 1, 5}, {3, 4, 1}};
    lines.segments = {{3, 2}, {0, 1}, {2, 4}}; // point 4 coincides with point 1
    CHECK(tubes(lines, {0.1, 5}).tubes == 1);
    lines.segments.push_back({3, 5});
    lines.segments.push_back({6, 3});
    const auto forked = tubes(lines, {0.1, 5});
    CHECK((forked.tubes == 3 && forked.segments == 5));
    CHECK(inspect(forked.mesh).components == 3);
    lines.segments.push_back({1, 4}); // without length
    lines.segments.push_back({1, 0}); // already present
    CHECK(tubes(lines, {0.1, 5}).skipped == 2);
    CHECK(tubes(lines, {0.1, 5}).mesh.positions == forked.mesh.positions);
}

TEST_CASE("a tube turns about a corner that is too sharp for a mitre", "[geometry]") {
    const auto hairpin = tubes(path({{0, 0, 0}, {5, 0, 0}, {0, 1, 0}}), {0.2, 8});
    CHECK(hairpin.sharp == 1);
    check_sound(hairpin.mesh, 2);
    CHECK(hairpin.mesh.bounds().max.x == Approx(5.1).epsilon(0.01)); // a mitre would go on to 5.5
    const auto back = tubes(path({{0, 0, 0}, {5, 0, 0}, {3, 0, 0}}), {0.2, 8});
    CHECK(back.sharp == 1);
    check_sound(back.mesh, 2);
    const auto crowded = tubes(path({{0, 0, 0}, {5, 0, 0}, {5, 0.05, 0}, {0, 0.05, 3}}), {1, 8});
    CHECK(crowded.sharp == 2);
    check_sound(crowded.mesh, 2);
    std::vector<Vec3> star; // closed, with sharp corners
    for (int i = 0; i < 5; ++i) star.push_back({std::cos(0.8 * pi * i), std::sin(0.8 * pi * i), 0.1 * i});
    check_sound(tubes(path(star, true), {0.9, 6}).mesh, 0);
}

TEST_CASE("a tube ends where the material changes, and its faces know theirs", "[geometry]") {
    Lines lines = path({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
    lines.segments[2].material = 7;
    const auto r = tubes(lines, {0.1, 4});
    CHECK(r.tubes == 2);
    REQUIRE(r.face_material.size() == r.mesh.face_count());
    CHECK(std::count(r.face_material.begin(), r.face_material.end(), 7U) == 6);
    CHECK(tubes(Lines{}, {1, 8}).mesh.face_count() == 0);
}

// Splits faces that cannot be cut independently: concave faces, faces that share two edges, large polygons.
// Also tests targets that are not reached.
#include "geometry/crumple/crumple.hpp"
#include "geometry/split/split.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

using namespace facetmill;

namespace {

Mesh faces(std::vector<Vec3> points, const std::vector<std::vector<Index>>& all) {
    Mesh mesh;
    mesh.positions = std::move(points);
    for (const auto& face : all) add_face(mesh, face);
    return mesh;
}

/// A quad with a reflex corner, by the number of that corner.
Mesh dart(Index reflex) {
    const std::vector<Vec3> points = {{0.5, 0, 0}, {2, 1, 0}, {0, 0, 0}, {2, -1, 0}};
    std::vector<Index> face(4);
    for (Index k = 0; k < 4; ++k) face[(k + reflex) % 4] = k;
    return faces(points, {face});
}

/// Two quads that share both edges at vertex 3, where the surface has a spike. Both would be cut along 0 -
/// 2.
Mesh pocket() {
    return faces({{1, 0, 0}, {0, 1, -0.5}, {-1, 0, 0}, {0, 0, 2}, {0, -1, -0.5}},
                 {{0, 1, 2, 3}, {0, 3, 2, 4}});
}

Mesh regular(Index corners) {
    Mesh mesh;
    std::vector<Index> face;
    for (Index k = 0; k < corners; ++k) {
        const double a = 6.283185307179586 * k / corners;
        mesh.positions.push_back({std::cos(a), std::sin(a), 0});
        face.push_back(k);
    }
    add_face(mesh, face);
    return mesh;
}

/// Twice the least signed area, along z, of the triangles that triangulated() makes of the faces.
double least_area(const Mesh& given) {
    const Mesh mesh = triangulated(given);
    double least = 1e300;
    for (Index c = 0; c < mesh.corner_count(); c += 3)
        least =
            std::min(least, cross(mesh.point(c + 1) - mesh.point(c), mesh.point(c + 2) - mesh.point(c)).z);
    return least;
}

/// Bent quads all over a closed surface.
Mesh bent_quads() { return crumple(grid_split(shapes::quad_cube(), 6).mesh, {.amplitude = 0.02}).mesh; }

} // namespace

TEST_CASE("concave quads are cut so that no piece looks the other way", "[geometry]") {
    using enum SplitMethod;
    for (Index reflex = 0; reflex < 4; ++reflex)
        for (const auto method : {diagonal, midpoint, quads, centroid, fan, core}) {
            const Mesh mesh = dart(reflex);
            for (const int passes : {1, 3}) {
                const SplitResult r = split(mesh, {method, passes});
                CAPTURE(to_string(method), reflex, passes);
                CHECK(test::area(triangulated(r.mesh)) == Approx(0.5).epsilon(1e-12));
                CHECK(least_area(r.mesh) > 0);
                CHECK(r.folded == 0);
            }
        }
}

TEST_CASE("concave faces whose pieces lie over each other are counted", "[geometry]") {
    using enum SplitMethod;
    for (const auto method : {grid, halve, varignon}) CHECK(split(dart(0), {method, 1}).folded == 1);
    // No point sees both arms.
    const Mesh fork =
        faces({{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {8, 9, 0}, {8, 1, 0}, {1, 1, 0}, {1, 9, 0}, {0, 9, 0}},
              {{0, 1, 2, 3, 4, 5, 6, 7}});
    CHECK(split(fork, {centroid, 1}).folded == 1);
    CHECK(split(regular(7), {centroid, 1}).folded == 0);
    CHECK(split(bent_quads(), {midpoint, 1}).folded == 0);
}

TEST_CASE("large concave faces are cut to a point that sees all of them", "[geometry]") {
    using enum SplitMethod;
    // The mean of the corners of the first is its reflex corner, of the second it is not seen from the arms.
    const std::vector<std::vector<Vec3>> shapes = {
        {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
        {{0, 0, 0}, {9, 0, 0}, {9, 1, 0}, {1, 1, 0}, {1, 9, 0}, {0, 9, 0}}};
    const double areas[] = {3, 17};
    for (std::size_t i = 0; i < shapes.size(); ++i)
        for (std::size_t turn = 0; turn < 6; ++turn)
            for (const auto method : {centroid, fan, quads, midpoint, core}) {
                auto points = shapes[i];
                std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(turn), points.end());
                for (Vec3& p : points) p = {p.x + 7, p.y - 0.5 * p.x, p.y}; // in a slanted plane
                const SplitResult r = split(faces(points, {{0, 1, 2, 3, 4, 5}}), {method, 1});
                CAPTURE(to_string(method), i, turn);
                const double whole = areas[i] * std::sqrt(1 + 0.25 + 1);
                CHECK(test::area(triangulated(r.mesh)) == Approx(whole).epsilon(1e-12));
                CHECK(least_area(r.mesh) > 1e-6);
                CHECK(r.folded == 0);
            }
}

TEST_CASE("diagonal cuts quads as triangulated does", "[geometry]") {
    for (const Mesh& mesh : {bent_quads(), dart(1), dart(2), shapes::moebius(9)}) {
        const Mesh cut = split(mesh, {SplitMethod::diagonal, 1}).mesh, other = triangulated(mesh);
        CHECK(cut.corners == other.corners);
        CHECK(cut.positions == other.positions);
    }
}

TEST_CASE("real quads stay closed and manifold", "[geometry]") {
    using enum SplitMethod;
    for (const auto method : {varignon, diagonal, midpoint, core, fan, halve, grid}) {
        CAPTURE(to_string(method));
        CHECK(test::sound(split(bent_quads(), {method, 1}).mesh, 2));
    }
}

TEST_CASE("quads that share two edges stay manifold with varignon and diagonal", "[geometry]") {
    const Mesh mesh = pocket();
    const auto before = test::count(mesh);
    REQUIRE(before.crowded == 0);
    CHECK(test::count(triangulated(mesh)).crowded == 0); // two diagonals would coincide, so one is flipped
    for (const auto method : {SplitMethod::varignon, SplitMethod::diagonal}) {
        const SplitResult r = split(mesh, {method, 1});
        const auto after = test::count(r.mesh);
        CAPTURE(to_string(method));
        CHECK(after.crowded == 0);
        CHECK(after.euler == before.euler);
        CHECK(r.shared == 0);
        CHECK(broken_invariants(r.mesh).empty());
    }
    CHECK(split(mesh, {SplitMethod::varignon, 1}).mesh.face_count() == 2 + 6); // two corners are kept
}

TEST_CASE("triangles back to back: their new edges coincide, and it is said where", "[geometry]") {
    using enum SplitMethod;
    const Mesh pillow = faces({{0, 0, 0}, {3, 0, 0}, {0, 2, 0}}, {{0, 1, 2}, {2, 1, 0}});
    REQUIRE(test::count(pillow).euler == 2);
    for (const auto method : {midpoint, grid}) {
        const SplitResult r = split(pillow, {method, 1});
        CHECK(r.shared == 3);
        CHECK(test::count(r.mesh).crowded == 3);
        CHECK(test::count(r.mesh).euler == 5);
    }
    CHECK(split(pillow, {bisect, 1}).shared > 0);
    CHECK(split(pillow, {notch, 1}).shared > 0);
    CHECK(split(pillow, {centroid, 1}).shared == 0);
    CHECK(test::count(split(pillow, {centroid, 1}).mesh).euler == 2);
    CHECK(split(shapes::icosphere(2), {midpoint, 2}).shared == 0);
    // Two quads around a tube, cut between the edges that they share.
    const Mesh tube = faces({{0, 0, 0}, {1, 0, 0}, {0, 9, 0}, {1, 9, 0}}, {{0, 2, 3, 1}, {0, 1, 3, 2}});
    CHECK(split(tube, {halve, 1}).shared > 0);
}

TEST_CASE("notch goes on after its quads are cut", "[geometry]") {
    const SplitResult r = split(shapes::icosphere(1), {SplitMethod::notch, 3});
    CHECK(r.passes == 3);
    CHECK(test::sound(r.mesh, 2));
    CHECK(test::volume(r.mesh) == Approx(test::volume(shapes::icosphere(1))).epsilon(1e-12));
    SplitSettings s{SplitMethod::notch, 5};
    s.min_angle = 0.9; // all are narrow, then none of some: what the last pass made is left as it is
    CHECK(test::sound(split(shapes::icosphere(1), s).mesh, 2));
}

TEST_CASE("the estimate knows how far the centre of a large polygon is, and the passes", "[geometry]") {
    SplitSettings s{SplitMethod::midpoint, 100};
    s.max_edge = 0.05;
    for (const auto method : {SplitMethod::midpoint, SplitMethod::quads}) {
        s.method = method;
        const SplitResult r = split(regular(100), s);
        CHECK(facet_shape(r.mesh).longest_edge <= 0.05);
        CHECK(r.stop == SplitResult::Stop::target);
        CHECK(static_cast<double>(r.mesh.corner_count()) <= split_corner_estimate(regular(100), s));
    }
    s.max_edge = 0.0006;
    CHECK(split_corner_estimate(regular(10000), s) > 1e11);
    for (const auto method : {SplitMethod::midpoint, SplitMethod::catmull_clark}) {
        s.method = method;
        CHECK(test::failure([&] { split(regular(10000), s); }).starts_with("limit [E-LIMIT]"));
    }
    s.method = SplitMethod::bisect;
    s.passes = 2;
    s.max_edge = 1e-9;
    CHECK(split_corner_estimate(shapes::cube(), s) == 3 * 16 * 12);
    CHECK(split(shapes::cube(), s).mesh.face_count() <= 16 * 12);
}

TEST_CASE("why a split ended", "[geometry]") {
    using Stop = SplitResult::Stop;
    const auto stop = [](SplitSettings s, const Mesh& mesh = shapes::cube()) { return split(mesh, s).stop; };
    CHECK(stop({SplitMethod::midpoint, 2}) == Stop::passes);
    for (const auto method : {SplitMethod::bisect, SplitMethod::midpoint}) {
        SplitSettings s{method, 1};
        s.max_edge = 0.3;
        CHECK(stop(s) == Stop::passes);
        s.passes = 100;
        CHECK(stop(s) == Stop::target);
        s.max_faces = 20;
        CHECK(stop(s) == Stop::budget);
        s.max_edge = 0;
        s.max_faces = 12;
        CHECK(stop(s) == Stop::budget);
    }
    SplitSettings s{SplitMethod::bisect, 9};
    s.min_angle = 0.1;
    CHECK(stop(s) == Stop::target);
    s.min_angle = 0;
    s.max_faces = 99;
    CHECK(stop(s, faces({{}, {}, {}}, {{0, 1, 2}})) == Stop::nothing);
}

TEST_CASE("cuts at the widest angle take no target", "[geometry]") {
    SplitSettings s{SplitMethod::bisect, 9};
    s.cut = SplitSettings::Cut::widest_angle;
    s.max_edge = 0.5;
    const Mesh needle = faces({{0, 0, 0}, {10, 0, 0}, {0.2, 0.1, 0}}, {{0, 1, 2}});
    CHECK(test::failure([&] { split(needle, s); }) ==
          "usage [E-CONFLICT] split: 'cut: widest-angle' cannot be combined with the target 'max_edge', "
          "because its cuts may never reach it | leave out cut, or give passes and no target");
    s.cut = SplitSettings::Cut::longest_edge;
    s.passes = 100;
    const SplitResult r = split(needle, s);
    CHECK(facet_shape(r.mesh).longest_edge <= 0.5);
    CHECK(r.stop == SplitResult::Stop::target);
}

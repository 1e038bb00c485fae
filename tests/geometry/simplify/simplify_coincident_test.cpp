// Simplification of surfaces whose borders touch without being welded.

#include "base/math/portable_math.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/simplify/simplify.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"
#include "support/catch.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using Method = SimplifySettings::Method;
using test::count;

namespace {

Mesh rough_sheet(int n) { return crumple(shapes::grid(n, n), {.amplitude = 0.05}).mesh; }

/// The patches of a sheet in squares of that side, as one mesh; their borders touch.
Mesh in_squares(const Mesh& sheet, double side) {
    std::map<std::pair<int, int>, Index> squares;
    std::vector<Index> labels(sheet.face_count());
    for (Index f = 0; f < labels.size(); ++f) {
        const Vec3 middle = (sheet.point(3 * f) + sheet.point(3 * f + 1) + sheet.point(3 * f + 2)) / 3;
        const std::pair square(static_cast<int>(middle.x / side), static_cast<int>(middle.y / side));
        labels[f] = squares.try_emplace(square, static_cast<Index>(squares.size())).first->second;
    }
    Mesh apart;
    for (const Mesh& patch : separated(sheet, labels, squares.size())) append(apart, patch);
    return apart;
}

} // namespace

TEST_CASE("borders of patches that touch stay matched, and the patches apart", "[geometry]") {
    // Nine rough squares side by side, cut from one sheet and never welded.
    const Mesh sheet = rough_sheet(30);
    const Mesh apart = in_squares(sheet, 10);
    const auto before = count(apart);
    REQUIRE(before.euler == 9);
    for (const Method method : {Method::quadric, Method::quadric_endpoints, Method::shortest_edge}) {
        const auto r = simplify(apart, {.method = method, .ratio = 0.1});
        CHECK(r.faces_after <= r.faces_before / 10);
        CHECK(r.vertices_after == r.mesh.vertex_count());
        CHECK(broken_invariants(r.mesh).empty());
        CHECK_FALSE(r.mesh.has_seams());
        CHECK(count(r.mesh).euler == 9);
        Mesh welded = r.mesh;
        weld_exact(welded);
        CHECK(count(welded).euler == 1); // no crack
        CHECK(count(welded).crowded == 0);
    }
    const auto by_count = simplify(apart, {.vertices = 200});
    CHECK(by_count.stop == SimplifyResult::Stop::vertices);
    CHECK(by_count.mesh.vertex_count() <= 200);
    CHECK(by_count.mesh.vertex_count() > 150);
    const auto within = simplify(apart, {.max_error = 0.05});
    Mesh welded = within.mesh;
    weld_exact(welded);
    CHECK(count(welded).euler == 1);
    SimplifySettings levels;
    levels.levels = {1, 0.5, 0.05};
    for (auto& level : simplify_levels(apart, levels)) {
        CHECK(count(level.mesh).euler == 9);
        weld_exact(level.mesh);
        CHECK(count(level.mesh).euler == 1);
    }
}

TEST_CASE("what borders that touch carry stays with their sides", "[geometry]") {
    Mesh m = in_squares(rough_sheet(20), 10);
    const Components patches = face_components(m);
    Attribute side{"side", Domain::vertex, Role::generic, 1, false, std::vector<double>(m.vertex_count())};
    for (Index c = 0; c < m.corner_count(); ++c) side.set_value(m.vertex(c), 0, patches.of_face[c / 3]);
    m.attributes.push_back(side);
    const auto r = simplify(m, {.ratio = 0.2});
    const Attribute* kept = r.mesh.find("side", Domain::vertex);
    REQUIRE(kept);
    CHECK_FALSE(r.mesh.find("side", Domain::wedge));
    const Components after = face_components(r.mesh);
    CHECK(after.count == 4);
    for (Index c = 0; c < r.mesh.corner_count(); ++c)
        CHECK(kept->value(r.mesh.vertex(c), 0) ==
              Approx(kept->value(r.mesh.vertex(3 * (c / 3)), 0))); // each patch has one number
}

TEST_CASE("a slit within a surface stays a hole, a seam from border to border stays matched", "[geometry]") {
    // A tube that was never closed: the first and the last column of a sheet have the same positions.
    Mesh tube = shapes::grid(24, 12);
    for (Vec3& p : tube.positions) {
        const double angle = p.x == 24 ? 0 : p.x / 24 * 2 * pi;
        p = {3 * cosine(angle), 3 * sine(angle), p.y};
    }
    const auto r = simplify(tube, {.ratio = 0.1});
    CHECK(count(r.mesh).euler == 1);
    Mesh welded = r.mesh;
    weld_exact(welded);
    CHECK(count(welded).euler == 0); // a tube
    CHECK(count(welded).crowded == 0);

    Mesh slit = shapes::grid(12, 12); // opened between (4, 6) and (8, 6)
    const auto at = [](const Vec3& p) { return p.y == 6 && p.x > 4 && p.x < 8; };
    std::map<Index, Index> twin;
    for (Index v = 0; v < 169; ++v)
        if (at(slit.positions[v])) {
            twin[v] = static_cast<Index>(slit.positions.size());
            slit.positions.push_back(Vec3(slit.positions[v]));
        }
    for (Index f = 0; f < slit.face_count(); ++f) {
        double y = 0;
        for (Index k = 0; k < 3; ++k) y += slit.point(3 * f + k).y / 3;
        for (Index k = 0; k < 3; ++k)
            if (y > 6 && twin.count(slit.corners[3 * f + k]))
                slit.corners[3 * f + k] = twin[slit.corners[3 * f + k]];
    }
    REQUIRE(count(slit).euler == 0);
    const auto least = simplify(slit, {.faces = 1});
    CHECK(count(least.mesh).euler == 0);
    Mesh closed = least.mesh;
    weld_exact(closed);
    CHECK(count(closed).euler == 1); // and both sides of it still match
}

#include "geometry/simplify/simplify.hpp"

#include "base/error.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "mesh/face.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/surface.hpp"

using namespace facetmill;
using Method = SimplifySettings::Method;
using Stop = SimplifyResult::Stop;
using test::count;
using test::sound;

namespace {

SimplifySettings at_levels(std::vector<double> ratios) {
    SimplifySettings s;
    s.levels = std::move(ratios);
    return s;
}

Mesh rough(Mesh m, double amplitude) { return crumple(std::move(m), {.amplitude = amplitude}).mesh; }

/// The two halves of a grid as UV islands: wedges are doubled along the middle column.
Mesh seamed_grid(Index n) {
    Mesh m = shapes::grid(static_cast<int>(n), static_cast<int>(n));
    m.wedge_vertex.resize(m.positions.size());
    for (Index v = 0; v < m.positions.size(); ++v) m.wedge_vertex[v] = v;
    std::map<Index, Index> twin;
    for (Index f = 0; f < m.face_count(); ++f) {
        double x = 0;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) x += m.positions[m.wedge_vertex[m.corners[c]]].x / 3;
        if (x < n / 2.0) continue;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) {
            const Index v = m.wedge_vertex[m.corners[c]];
            if (m.positions[v].x != n / 2.0) continue;
            const auto [at, fresh] = twin.emplace(v, static_cast<Index>(m.wedge_vertex.size()));
            if (fresh) m.wedge_vertex.push_back(v);
            m.corners[c] = at->second;
        }
    }
    Attribute uv;
    uv.name = "TEXCOORD_0";
    uv.role = Role::uv;
    uv.components = 2;
    std::vector<double> data;
    for (Index w = 0; w < m.wedge_count(); ++w) {
        const Vec3& p = m.positions[m.wedge_vertex[w]];
        data.push_back(p.x + (w >= m.positions.size() ? 100 : 0));
        data.push_back(p.y);
    }
    uv.data = std::move(data);
    m.attributes.push_back(std::move(uv));
    return m;
}

/// A cube of side 8: every side of the quad cube as 8 x 8 squares.
Mesh gridded_cube() {
    Mesh m;
    const Mesh sheet = shapes::grid(8, 8);
    const Vec3 frames[6][3] = {{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, {{0, 0, 8}, {1, 0, 0}, {0, 1, 0}},
                               {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 8, 0}, {0, 0, 1}, {1, 0, 0}},
                               {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {{8, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const auto& f : frames) {
        Mesh side = sheet;
        for (auto& p : side.positions) p = f[0] + f[1] * p.x + f[2] * p.y;
        append(m, side);
    }
    weld_exact(m);
    return m;
}

} // namespace

TEST_CASE("a sphere is simplified to the count asked for and stays a sphere", "[geometry]") {
    const Mesh m = shapes::icosphere(4); // 5120 faces
    for (const Method method : {Method::quadric, Method::shortest_edge}) {
        Mesh now = m;
        for (const std::size_t target : {4000u, 3000u, 2000u, 1000u}) {
            const auto r = simplify(now, {.method = method, .faces = target});
            CHECK(r.stop == Stop::faces);
            CHECK(r.faces_after == target);
            CHECK(r.mesh.face_count() == target);
            CHECK(broken_invariants(r.mesh).empty());
            CHECK(sound(r.mesh, 2));
            now = r.mesh;
        }
        // 1000 faces inscribed in the sphere lack about 1 % of its volume, and midpoints lose slightly more.
        CHECK(test::volume(now) == Approx(test::volume(m)).epsilon(method == Method::quadric ? 0.005 : 0.02));
        for (const Vec3& p : now.positions) CHECK(std::abs(length(p) - 1) < 0.04);
    }
}

TEST_CASE("a torus keeps its hole down to where topology stops it", "[geometry]") {
    const Mesh m = rough(shapes::torus(60, 30), 0.005);
    for (const Method method : {Method::quadric, Method::shortest_edge}) {
        CHECK(sound(simplify(m, {.method = method, .ratio = 0.1}).mesh, 0));
        const auto least = simplify(m, {.method = method, .faces = 2});
        CHECK(least.stop == Stop::stuck);
        CHECK(least.blocked.topology + least.blocked.flips > 0);
        CHECK(sound(least.mesh, 0));
        CHECK(least.faces_after < 100);
    }
}

TEST_CASE("no component vanishes", "[geometry]") {
    Mesh m = shapes::icosphere(2);
    Mesh small = shapes::icosphere(1);
    for (auto& p : small.positions) p = p * 0.01 + Vec3{3, 0, 0};
    append(m, small);
    const auto r = simplify(m, {.faces = 1});
    CHECK(r.stop == Stop::stuck);
    CHECK(sound(r.mesh, 4));
    CHECK(sound(simplify(shapes::tetrahedron(), {.faces = 1}).mesh, 2));
}

TEST_CASE("a flat part of a cube goes, its edges and corners stay", "[geometry]") {
    const Mesh m = gridded_cube();
    REQUIRE(sound(m, 2));
    const auto r = simplify(m, {.faces = 12});
    CHECK(r.faces_after == 12);
    CHECK(sound(r.mesh, 2));
    CHECK(test::volume(r.mesh) == Approx(512).epsilon(1e-6));
    CHECK(*r.largest_error < 0.01);
}

TEST_CASE("an edge that was refused goes once its surroundings let it, before a corner does", "[geometry]") {
    for (const std::size_t first : {200u, 100u, 60u, 40u}) {
        INFO(first);
        const Mesh some =
            simplify(gridded_cube(), {.method = Method::quadric_endpoints, .faces = first}).mesh;
        const auto r = simplify(some, {.method = Method::quadric_endpoints, .faces = 12});
        CHECK(r.faces_after == 12);
        CHECK(test::volume(r.mesh) == Approx(512).epsilon(1e-6));
    }
}

TEST_CASE("the boundary of an open sheet keeps its shape", "[geometry]") {
    const Mesh m = shapes::grid(16, 16);
    const auto r = simplify(m, {.ratio = 0.02});
    CHECK(r.stop == Stop::ratio);
    CHECK(count(r.mesh).euler == 1);
    CHECK(count(r.mesh).crowded == 0);
    CHECK(test::area(r.mesh) == Approx(256).epsilon(1e-6));
    // The method of P. Bourke, "Surface (polygonal) Simplification" (1997), ignores the shape. It moves
    // along the boundary's edges and cuts corners.
    const auto note = simplify(m, {.method = Method::shortest_edge, .ratio = 0.25});
    CHECK(count(note.mesh).euler == 1);
    CHECK(test::area(note.mesh) > 0.95 * 256);
}

TEST_CASE("a locked boundary stays vertex by vertex", "[geometry]") {
    const Mesh m = rough(shapes::grid(12, 12), 0.05);
    for (const Method method : {Method::quadric, Method::shortest_edge}) {
        const auto r = simplify(m, {.method = method, .lock = {.boundary = true}, .faces = 1});
        CHECK(r.stop == Stop::stuck);
        CHECK(r.blocked.borders > 0);
        CHECK(count(r.mesh).open == 48);
        CHECK(count(r.mesh).euler == 1);
        std::set<std::array<double, 3>> places;
        for (const Vec3& p : r.mesh.positions) places.insert({p.x, p.y, p.z});
        const Mesh flat = shapes::grid(12, 12);
        for (std::size_t v = 0; v < m.positions.size(); ++v) {
            const Vec3 &p = m.positions[v], &q = flat.positions[v];
            if (q.x == 0 || q.y == 0 || q.x == 12 || q.y == 12) CHECK(places.count({p.x, p.y, p.z}) == 1);
        }
    }
}

TEST_CASE("what is not manifold stays, the rest is simplified", "[geometry]") {
    Mesh m = shapes::icosphere(3);
    append(m, shapes::fan3());
    append(m, shapes::hourglass());
    append(m, shapes::bowtie());
    const auto before = count(m);
    const auto r = simplify(m, {.ratio = 0.2});
    CHECK(r.stop == Stop::ratio);
    const auto after = count(r.mesh);
    CHECK(after.euler == before.euler);
    CHECK(after.crowded == before.crowded);
    CHECK(after.pinched == before.pinched);
    CHECK(after.duplicates == 0);
    CHECK(broken_invariants(r.mesh).empty());
}

TEST_CASE("what lies around vertices that are not manifold is simplified", "[geometry]") {
    // Two sheets joined at every second vertex of a row: a chain of slits, each with two vertices between.
    constexpr Index cells = 16, row = cells + 1;
    Mesh m = shapes::grid(cells, cells);
    for (Index x = 1; x < cells; x += 2) {
        const Index v = cells / 2 * row + x, twin = static_cast<Index>(m.vertex_count());
        m.positions.push_back(m.positions[v] + Vec3{0, 1e-3, 0});
        for (Index f = 0; f < m.face_count(); ++f)
            for (Index c = 3 * f; c < 3 * f + 3; ++c)
                if (m.corners[c] == v && corner_mean(m, f).y > m.positions[v].y) m.corners[c] = twin;
    }
    const auto before = count(m);
    REQUIRE(before.pinched > 0);
    const auto r = simplify(m, {.ratio = 32.0 / 512});
    CHECK(r.stop == Stop::ratio); // with both vertices of each slit there are at least 34
    const auto after = count(r.mesh);
    CHECK(after.euler == before.euler);
    CHECK(after.pinched == before.pinched);
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(deviation(m, r.mesh).maximum() < 2e-3);
}

TEST_CASE("doubled and degenerate faces are carried along", "[geometry]") {
    Mesh m = shapes::icosphere(3);
    add_face(m, std::array<Index, 3>{m.corners[0], m.corners[1], m.corners[2]});
    add_face(m, std::array<Index, 3>{m.corners[90], m.corners[90], m.corners[91]});
    const auto r = simplify(m, {.ratio = 0.2});
    CHECK(r.stop == Stop::ratio);
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(count(r.mesh).duplicates == 1);
}

TEST_CASE("meshes without area or faces are no trouble", "[geometry]") {
    Mesh line;
    for (int i = 0; i < 50; ++i) line.positions.push_back({double(i), 0, 0});
    for (Index i = 0; i + 2 < 50; ++i) add_face(line, std::array<Index, 3>{i, i + 1, i + 2});
    CHECK(broken_invariants(simplify(line, {.ratio = 0.1}).mesh).empty());
    Mesh point;
    point.positions.assign(9, {1, 2, 3});
    for (Index i = 0; i + 2 < 9; ++i) add_face(point, std::array<Index, 3>{i, i + 1, i + 2});
    CHECK(broken_invariants(simplify(point, {.ratio = 0.1}).mesh).empty());
    CHECK(simplify(Mesh{}, {.ratio = 0.1}).stop == Stop::nothing);
}

TEST_CASE("a fan with thousands of faces at one vertex ends", "[geometry]") {
    const auto r = simplify(shapes::open_cone(5000), {.ratio = 0.05});
    CHECK(r.stop == Stop::ratio);
    CHECK(count(r.mesh).euler == 1);
}

TEST_CASE("seams stay seams, matched, and UVs follow the place", "[geometry]") {
    const Mesh m = seamed_grid(16);
    const auto r = simplify(m, {.ratio = 0.1});
    CHECK(r.stop == Stop::ratio);
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(test::area(r.mesh) == Approx(256).epsilon(1e-6));
    const Attribute* uv = r.mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    std::map<Index, int> wedges;
    for (Index w = 0; w < r.mesh.wedge_count(); ++w) {
        const Vec3& p = r.mesh.positions[r.mesh.vertex_of_wedge(w)];
        ++wedges[r.mesh.vertex_of_wedge(w)];
        CHECK(uv->value(w, 1) == Approx(p.y).margin(1e-9)); // the sheet is flat, so no vertex slides
        const double u = uv->value(w, 0);
        CHECK((u < 50 ? u : u - 100) == Approx(p.x).margin(1e-9));
    }
    for (const auto& [v, n] : wedges) CHECK((n == 2) == (std::abs(r.mesh.positions[v].x - 8) < 1e-3));
    REQUIRE(r.changes.size() == 1);
    CHECK(r.changes[0].kind == AttributeChange::Kind::interpolated);
}

TEST_CASE("borders of primitives stay where they are", "[geometry]") {
    Mesh m = shapes::grid(16, 16);
    m.primitives.resize(2);
    m.primitives[1].material = 1;
    Attribute a;
    a.name = primitive_attribute;
    a.domain = Domain::face;
    a.role = Role::index;
    std::vector<std::uint32_t> of(m.face_count());
    for (Index f = 0; f < m.face_count(); ++f) {
        const double x = (m.point(3 * f).x + m.point(3 * f + 1).x + m.point(3 * f + 2).x) / 3;
        of[f] = x > 8;
    }
    a.data = of;
    m.attributes.push_back(a);
    const auto r = simplify(m, {.ratio = 0.1});
    double left = 0;
    for (Index f = 0; f < r.mesh.face_count(); ++f)
        if (r.mesh.primitive_of(f) == 0)
            left += cross(r.mesh.point(3 * f + 1) - r.mesh.point(3 * f),
                          r.mesh.point(3 * f + 2) - r.mesh.point(3 * f))
                        .z /
                    2;
    CHECK(left == Approx(128).epsilon(1e-4));
}

TEST_CASE("an attribute that is linear in the position stays with the position", "[geometry]") {
    Mesh m = rough(shapes::icosphere(4), 0.002);
    test::add_coordinates(m);
    const auto r = simplify(m, {.ratio = 0.25});
    const Attribute* a = r.mesh.find("coordinates", Domain::wedge);
    REQUIRE(a);
    double worst = 0;
    for (Index w = 0; w < r.mesh.wedge_count(); ++w) {
        const Vec3 p = r.mesh.positions[w], q{a->value(w, 0), a->value(w, 1), a->value(w, 2)};
        worst = std::max(worst, length(p - q));
    }
    CHECK(worst < 0.01); // no farther than the surface itself moved
}

TEST_CASE("the first target met is reported", "[geometry]") {
    const Mesh m = shapes::icosphere(3); // 1280 faces, 642 vertices
    CHECK(simplify(m, {.ratio = 0.5, .faces = 100}).stop == Stop::ratio);
    CHECK(simplify(m, {.ratio = 0.5, .faces = 1000}).stop == Stop::faces);
    const auto r = simplify(m, {.faces = 10, .vertices = 300});
    CHECK(r.stop == Stop::vertices);
    CHECK(r.vertices_after == 300);
    CHECK(r.mesh.vertex_count() == 300);
}

TEST_CASE("a mesh at its target comes back as it was", "[geometry]") {
    const Mesh m = shapes::quad_cube();
    const auto r = simplify(m, {.faces = 12});
    CHECK(r.stop == Stop::nothing);
    CHECK(test::same(r.mesh, m));
    CHECK(r.faces_given == 6);
    CHECK(r.faces_before == 12);
}

TEST_CASE("units and place do not matter", "[geometry]") {
    const Mesh m = rough(shapes::icosphere(4), 0.01);
    const auto plain = simplify(m, {.ratio = 0.2});
    Mesh far = m;
    for (auto& p : far.positions) p = p * 0x1p-40;
    const auto tiny = simplify(far, {.ratio = 0.2});
    CHECK(tiny.mesh.corners == plain.mesh.corners);
    CHECK(*tiny.largest_error == *plain.largest_error * 0x1p-40);
    for (auto& p : far.positions) p = p * 0x1p1000;
    CHECK(sound(simplify(far, {.ratio = 0.2}).mesh, 2));
}

TEST_CASE("simplification gives the same bytes for any number of threads", "[geometry]") {
    Mesh m = rough(shapes::icosphere(6), 0.002); // several stretches
    test::add_coordinates(m);
    for (const Method method : {Method::quadric, Method::shortest_edge})
        CHECK(test::same_for_any_threads([&] { return simplify(m, {.method = method, .ratio = 0.1}).mesh; }));
}

TEST_CASE("max_error bounds the measured deviation, and nearly reaches it", "[geometry]") {
    const Mesh m = rough(shapes::icosphere(4), 0.002);
    for (const Method method : {Method::quadric, Method::shortest_edge})
        for (const double bound : {0.003, 0.02, 0.1}) {
            const auto r = simplify(m, {.method = method, .max_error = bound});
            CHECK(r.stop == Stop::max_error);
            CHECK(r.blocked.error > 0);
            REQUIRE(r.measured);
            CHECK(*r.measured == deviation(m, r.mesh).maximum());
            CHECK(*r.measured <= bound);
            CHECK(*r.measured > 0.6 * bound);
            CHECK(sound(r.mesh, 2));
            CHECK(broken_invariants(r.mesh).empty());
            CHECK(r.mesh.face_count() == r.faces_after);
            CHECK(r.mesh.vertex_count() == r.vertices_after);
        }
}

TEST_CASE("max_error holds on surfaces of all kinds, the same for any number of threads", "[geometry]") {
    Mesh folded = shapes::grid(60, 60); // a sharp fold, and single vertices that stick out
    for (std::size_t v = 0; v < folded.positions.size(); ++v) {
        Vec3& p = folded.positions[v];
        p.z = std::abs(p.x - 30.3) + (v % 97 == 0 ? 0.6 : 0.0);
    }
    for (const Mesh& m : {folded, rough(shapes::icosphere(5), 0.02), shapes::cube()})
        for (const double share : {0.0003, 0.003, 0.03}) {
            const double bound = share * m.bounds().diagonal();
            CAPTURE(m.face_count(), share);
            const auto r = simplify(m, {.max_error = bound});
            CHECK(deviation(m, r.mesh).maximum() <= bound);
            CHECK(*r.measured == deviation(m, r.mesh).maximum());
            CHECK(test::same_for_any_threads([&] { return simplify(m, {.max_error = bound}).mesh; }));
        }
}

TEST_CASE("with max_error and a count only the first one met stops the work", "[geometry]") {
    const Mesh m = shapes::icosphere(4); // 5120 faces
    CHECK(simplify(m, {.faces = 4000, .max_error = 0.5}).stop == Stop::faces);
    CHECK(simplify(m, {.faces = 10, .max_error = 0.01}).stop == Stop::max_error);
    const auto none = simplify(m, {.max_error = 1e-9}); // not one collapse is within
    CHECK(none.stop == Stop::max_error);
    CHECK(none.faces_after == 5120);
    CHECK(none.measured < 1e-12);
}

TEST_CASE("what was rolled back keeps its attributes and seams", "[geometry]") {
    Mesh m = seamed_grid(16);
    for (auto& p : m.positions) p.z = 0.1 * p.x * p.y / 16 + ((p.x > 4 && p.x < 9 && p.y > 5) ? 0.3 : 0.0);
    const auto r = simplify(m, {.max_error = 0.12});
    CHECK(r.stop == Stop::max_error);
    CHECK(broken_invariants(r.mesh).empty());
    CHECK(count(r.mesh).euler == 1);
    const Attribute* uv = r.mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    std::map<Index, int> wedges;
    for (Index w = 0; w < r.mesh.wedge_count(); ++w) {
        const Vec3& p = r.mesh.positions[r.mesh.vertex_of_wedge(w)];
        ++wedges[r.mesh.vertex_of_wedge(w)];
        CHECK(uv->value(w, 1) == Approx(p.y).margin(0.12));
        CHECK(std::fmod(uv->value(w, 0), 100) == Approx(p.x).margin(0.12));
    }
    for (const auto& [v, n] : wedges) CHECK((n == 2) == (std::abs(r.mesh.positions[v].x - 8) < 1e-3));
}

TEST_CASE("endpoints alone keep the vertices a subset", "[geometry]") {
    const Mesh m = rough(shapes::icosphere(3), 0.01);
    const auto r = simplify(m, {.method = Method::quadric_endpoints, .ratio = 0.1});
    CHECK(sound(r.mesh, 2));
    std::set<std::array<double, 3>> places;
    for (const Vec3& p : m.positions) places.insert({p.x, p.y, p.z});
    for (const Vec3& p : r.mesh.positions) CHECK(places.count({p.x, p.y, p.z}) == 1);
}

TEST_CASE("locked seams, groups and boxes stay vertex by vertex", "[geometry]") {
    const auto along = [](const Mesh& mesh, auto&& on) {
        return std::count_if(mesh.positions.begin(), mesh.positions.end(), on);
    };
    const auto seam = [](const Vec3& p) { return p.x == 8; };
    CHECK(along(simplify(seamed_grid(16), {.lock = {.seams = true}, .faces = 1}).mesh, seam) == 17);
    CHECK(along(simplify(seamed_grid(16), {.faces = 60}).mesh, seam) < 17);
    Mesh m = shapes::grid(16, 16);
    std::vector<std::uint32_t> groups(m.face_count());
    for (Index f = 0; f < groups.size(); ++f)
        groups[f] = (m.point(3 * f).x + m.point(3 * f + 1).x + m.point(3 * f + 2).x) / 3 > 8;
    m.attributes.push_back({"group", Domain::face, Role::index, 1, false, groups});
    CHECK(along(simplify(m, {.lock = {.groups = true}, .faces = 1}).mesh, seam) == 17);
    const auto free = simplify(m, {.faces = 60});
    CHECK(along(free.mesh, seam) < 17);
    CHECK(test::area(free.mesh) == Approx(256).epsilon(1e-6));
    const std::vector<Plane> body{{{1, 0, 0}, {2.5, 0, 0}},
                                  {{-1, 0, 0}, {7.5, 0, 0}},
                                  {{0, 1, 0}, {0, 2.5, 0}},
                                  {{0, -1, 0}, {0, 9.5, 0}}};
    const auto inside = [&](const Vec3& p) { return p.x > 2.5 && p.x < 7.5 && p.y > 2.5 && p.y < 9.5; };
    const auto boxed = simplify(m, {.lock = {.body = body}, .faces = 1});
    CHECK(along(boxed.mesh, inside) == 5 * 7);
    CHECK(boxed.blocked.borders > 0);
}

TEST_CASE("levels of detail are one chain", "[geometry]") {
    Mesh m = rough(shapes::icosphere(4), 0.005);
    test::add_coordinates(m);
    const auto levels = simplify_levels(m, at_levels({1, 0.5, 0.2, 0.05}));
    REQUIRE(levels.size() == 4);
    CHECK(levels[0].stop == Stop::nothing);
    CHECK(test::same(levels[0].mesh, m));
    for (std::size_t i = 1; i < 4; ++i) {
        CHECK(levels[i].stop == Stop::ratio);
        CHECK(levels[i].mesh.face_count() == levels[i].faces_after);
        CHECK(sound(levels[i].mesh, 2));
        CHECK(levels[i].largest_error >= levels[i - 1].largest_error);
        CHECK(levels[i].collapses == 2562 - levels[i].vertices_after);
    }
    // The first level equals the result of a separate run.
    CHECK(test::same(levels[1].mesh, simplify(m, {.ratio = 0.5}).mesh));
    CHECK(simplify_levels(shapes::cube(), at_levels({0.5, 0.25}))[1].stop == Stop::stuck);
    CHECK(
        test::failure([] {
            simplify_levels(shapes::cube(), at_levels({0.25, 0.5}));
        }) ==
        "usage [E-RANGE] simplify: lods: ratios must go from fine to coarse | for example [100%, 50%, 10%]");
}

TEST_CASE("simplification refuses to guess a target", "[geometry]") {
    CHECK(test::failure([] { simplify(shapes::cube(), {}); }) ==
          "usage [E-RANGE] simplify: a target is needed: ratio, faces, vertices or max_error");
    CHECK(test::failure([] { simplify(shapes::cube(), {.ratio = 2}); }) ==
          "usage [E-RANGE] simplify: ratio is 0 < x <= 1, not 2");
}

TEST_CASE("simplification avoids new self-intersections on request", "[geometry]") {
    // Two sheets, one close above the other and rough: alone each simplifies, together they would cross. The
    // upper one is half as rough, so that the two are not simplified alike.
    Mesh m = rough(shapes::grid(24, 24), 0.1);
    Mesh above = m;
    for (auto& p : above.positions) p.z = (p.z + m.bounds().max.z) / 2 + 0.02;
    append(m, above);
    using Intersections = SimplifySettings::Intersections;
    const auto free = simplify(m, {.self_intersections = Intersections::count, .ratio = 0.2});
    REQUIRE(free.intersections_before == 0u);
    REQUIRE(*free.intersections_after > 0);
    CHECK(free.held == 0);
    const auto avoided = simplify(m, {.self_intersections = Intersections::avoid, .ratio = 0.2});
    CHECK(avoided.intersections_after == 0u);
    CHECK(find_self_intersections(avoided.mesh).count == 0);
    CHECK(avoided.held > 0);
    CHECK(avoided.faces_after < 3 * m.face_count() / 4); // not all faces return to their original state
    CHECK(count(avoided.mesh).euler == 2);
}

TEST_CASE("where faces would cross less is taken away, elsewhere all", "[geometry]") {
    // A ball that is nearly filled by a smaller ball: the distance is sufficient while faces are small.
    Mesh m = rough(shapes::icosphere(4), 0.002);
    Mesh inner = m;
    for (auto& p : inner.positions) p = p * 0.97;
    append(m, inner);
    using Intersections = SimplifySettings::Intersections;
    const auto free = simplify(m, {.self_intersections = Intersections::count, .ratio = 0.02});
    REQUIRE(*free.intersections_after > 0);
    const auto avoided = simplify(m, {.self_intersections = Intersections::avoid, .ratio = 0.02});
    CHECK(avoided.intersections_after == 0u);
    CHECK(avoided.faces_after < m.face_count() / 4);
}

TEST_CASE("the constrained method keeps its constraints, seams and guarantees", "[geometry]") {
    const Mesh m = rough(shapes::icosphere(3), 0.005);
    const auto r = simplify(m, {.method = Method::constrained, .ratio = 0.2});
    CHECK(r.stop == Stop::ratio);
    CHECK_FALSE(r.largest_error); // OpenMesh does not report it
    CHECK(sound(r.mesh, 2));
    CHECK(broken_invariants(r.mesh).empty());
    const auto near =
        simplify(m, {.method = Method::constrained, .constraints = {.hausdorff = 0.004}, .ratio = 0.05});
    CHECK(near.stop == Stop::stuck);
    const FaceTree tree(surface_of(near.mesh));
    for (const Vec3& p : m.positions) CHECK(closest_point(tree, p).distance <= 0.004 * (1 + 1e-9));
    CHECK(deviation(m, r.mesh).maximum() > deviation(m, near.mesh).maximum());
    const auto seamed = simplify(seamed_grid(12), {.method = Method::constrained, .ratio = 0.1});
    CHECK(broken_invariants(seamed.mesh).empty());
    CHECK(count(seamed.mesh).euler == 1);
    const Attribute* uv = seamed.mesh.find("TEXCOORD_0", Domain::wedge);
    REQUIRE(uv);
    for (Index f = 0; f < seamed.mesh.face_count(); ++f) {
        double x = 0; // of the centre; the right side of the seam has its wedges at u + 100
        for (Index c = 3 * f; c < 3 * f + 3; ++c) x += seamed.mesh.point(c).x / 3;
        for (Index c = 3 * f; c < 3 * f + 3; ++c) {
            const double at = seamed.mesh.point(c).x, u = uv->value(seamed.mesh.corners[c], 0);
            CHECK(u == Approx(at == 6 && x > 6 ? at + 100 : at));
        }
    }
    Mesh broken = shapes::icosphere(2);
    append(broken, shapes::fan3());
    append(broken, shapes::hourglass());
    const auto kept = simplify(broken, {.method = Method::constrained, .ratio = 0.3});
    CHECK(count(kept.mesh).crowded == count(broken).crowded);
    CHECK(count(kept.mesh).euler == count(broken).euler);
}

TEST_CASE("a surface whose faces disagree is simplified as if they agreed, and faces as it did",
          "[geometry]") {
    const Mesh agreed = rough(shapes::icosphere(4), 0.002);
    Mesh mixed = agreed;
    std::vector<std::uint8_t> turned(mixed.face_count());
    for (Index f = 0; f < mixed.face_count(); f += 3) {
        std::swap(mixed.corners[3 * f + 1], mixed.corners[3 * f + 2]);
        turned[f] = 1;
    }
    const auto flips = std::size_t(std::count(turned.begin(), turned.end(), 1));
    mixed.attributes.push_back({"turned", Domain::face, Role::generic, 1, false, turned});
    for (const Method method :
         {Method::quadric, Method::quadric_endpoints, Method::shortest_edge, Method::constrained}) {
        const auto plain = simplify(agreed, {.method = method, .ratio = 0.3});
        const auto r = simplify(mixed, {.method = method, .ratio = 0.3});
        CHECK(r.turned == flips);
        CHECK(r.stop == Stop::ratio);
        CHECK(r.mesh.positions == plain.mesh.positions);
        REQUIRE(r.mesh.corners.size() == plain.mesh.corners.size());
        const Attribute* was = r.mesh.find("turned", Domain::face);
        REQUIRE(was);
        for (Index f = 0; f < r.mesh.face_count(); ++f) {
            const std::size_t other = was->value(f, 0) == 1 ? 1 : 0;
            CHECK(r.mesh.corners[3 * f] == plain.mesh.corners[3 * f]);
            CHECK(r.mesh.corners[3 * f + 1] == plain.mesh.corners[3 * f + 1 + other]);
            CHECK(r.mesh.corners[3 * f + 2] == plain.mesh.corners[3 * f + 2 - other]);
        }
    }
    CHECK(simplify(agreed, {.ratio = 0.3}).turned == 0);
}

TEST_CASE("shortest-edge keeps the corners of an open sheet", "[geometry]") {
    const auto area = [](const Mesh& m) {
        double sum = 0;
        for (Index f = 0; f < m.face_count(); ++f)
            sum +=
                length(cross(m.point(3 * f + 1) - m.point(3 * f), m.point(3 * f + 2) - m.point(3 * f))) / 2;
        return sum;
    };
    const Mesh sheet = shapes::grid(20, 20);
    for (const double ratio : {0.2, 0.02}) {
        const auto r = simplify(sheet, {.method = Method::shortest_edge, .ratio = ratio});
        CHECK(double(r.faces_after) <= ratio * double(r.faces_before) + 1);
        CHECK(area(r.mesh) == Approx(400));
        const Box box = r.mesh.bounds();
        CHECK(box.max == Vec3{20, 20, 0});
        for (const Vec3 corner : {Vec3{0, 0, 0}, Vec3{20, 0, 0}, Vec3{0, 20, 0}, Vec3{20, 20, 0}})
            CHECK(std::count(r.mesh.positions.begin(), r.mesh.positions.end(), corner) == 1);
    }
}

TEST_CASE("locked vertices that are to stay apart get no edge to each other", "[simplify]") {
    Mesh m = rough(shapes::icosphere(4), 0.01);
    SimplifySettings s;
    s.faces = 100;
    s.lock.vertices.resize(m.vertex_count());
    for (std::size_t v = 0; v < m.vertex_count(); v += 9) s.lock.vertices[v] = 1;
    s.lock.apart = true;
    std::set<std::pair<Index, Index>> before;
    for (Index c = 0; c < m.corner_count(); ++c)
        before.insert({m.vertex(c), m.vertex(c % 3 == 2 ? c - 2 : c + 1)});
    const auto new_edges = [&](const SimplifyResult& r) {
        std::size_t found = 0;
        for (Index c = 0; c < r.mesh.corner_count(); ++c) {
            const Index a = r.sources[r.mesh.vertex(c)],
                        b = r.sources[r.mesh.vertex(c % 3 == 2 ? c - 2 : c + 1)];
            found += s.lock.vertices[a] && s.lock.vertices[b] && !before.contains({a, b});
        }
        return found;
    };
    const SimplifyResult apart = simplify(m, s);
    CHECK(sound(apart.mesh, 2));
    CHECK(new_edges(apart) == 0);
    REQUIRE(apart.sources.size() == apart.mesh.vertex_count());
    for (Index v = 0; v < apart.mesh.vertex_count(); ++v)
        if (s.lock.vertices[apart.sources[v]])
            CHECK(apart.mesh.positions[v] == m.positions[apart.sources[v]]);
    s.lock.apart = false;
    CHECK(new_edges(simplify(m, s)) > 0);
}

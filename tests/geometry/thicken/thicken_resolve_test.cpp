#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/thicken/thicken.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/invariants.hpp"
#include "mesh/placement.hpp"
#include "mesh/topology.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// A ball with dents and spikes, whose copy at the thickness folds over.
Mesh rough_ball() { return test::noisy_icosphere(2, 0.3, 1); }

ThickenResult resolved(const Mesh& mesh, double thickness, ThickenSide side, const Transform& to_world = {}) {
    const ThickenSettings plain{.thickness = thickness, .side = side, .to_world = to_world};
    const ThickenResult folded = thicken(mesh, plain);
    CHECK(folded.self_intersections.value_or(0) > 0);
    CHECK_FALSE(folded.resolved);
    ThickenSettings settings = plain;
    settings.resolve = true;
    ThickenResult r = thicken(mesh, settings);
    CHECK(r.resolved);
    CHECK(r.turned == 0);
    CHECK(r.self_intersections == 0);
    CHECK(broken_invariants(r.mesh).empty());
    const Properties p = inspect(r.mesh);
    CHECK(p.closed);
    CHECK(p.edge_manifold);
    CHECK(p.oriented);
    CHECK(find_self_intersections(r.mesh, {.separate_touching = true}).count == 0);
    return r;
}

} // namespace

TEST_CASE("thicken makes a hollow solid again where its walls fold", "[geometry]") {
    const Mesh ball = rough_ball();
    const double whole = test::volume(ball);
    const ThickenResult inward = resolved(ball, 0.2, ThickenSide::inward);
    CHECK(test::volume(inward.mesh) < 0.8 * whole); // it is hollow
    CHECK(test::volume(inward.mesh) > 0.2 * whole);
    CHECK(inspect(inward.mesh).components == 2); // no splinters
    CHECK(inward.wall->thinnest > 0.02);
    const ThickenResult outward = resolved(ball, 0.8, ThickenSide::outward);
    CHECK(test::volume(outward.mesh) > 0.2 * whole);
    CHECK(inspect(outward.mesh).components == 2);
    CHECK(outward.mesh.bounds().max.x > ball.bounds().max.x);
    CHECK(resolved(ball, 0.5, ThickenSide::centred).wall->thinnest > 0.02);
}

TEST_CASE("thicken resolves walls of open surfaces, and in the world's lengths", "[geometry]") {
    Mesh open = rough_ball();
    open.corners.resize(open.corners.size() - 3 * 20);
    drop_unused(open);
    CHECK(resolved(open, 0.2, ThickenSide::inward).wall_faces > 0);
    Transform tenfold;
    for (int i = 0; i < 3; ++i) tenfold.m[i][i] = 10;
    const Mesh ball = rough_ball();
    CHECK(resolved(ball, 2, ThickenSide::inward, tenfold).wall->thinnest ==
          Approx(10 * resolved(ball, 0.2, ThickenSide::inward).wall->thinnest));
}

TEST_CASE("thicken leaves what does not fold as it is, also when it is to resolve", "[geometry]") {
    const Mesh cube = shapes::cube();
    const ThickenResult plain = thicken(cube, {.thickness = 0.1}),
                        same = thicken(cube, {.thickness = 0.1, .resolve = true});
    CHECK_FALSE(same.resolved);
    CHECK(same.mesh.positions == plain.mesh.positions);
    CHECK(same.mesh.corners == plain.mesh.corners);
}

namespace {

constexpr int sides = 32;

/// A regular polygon whose corners have that distance from the z axis.
std::vector<Vec3> ring_at(double radius, double z) {
    std::vector<Vec3> ring;
    ring.reserve(sides);
    for (int i = 0; i < sides; ++i)
        ring.push_back({radius * cosine(2 * pi * i / sides), radius * sine(2 * pi * i / sides), z});
    return ring;
}

double polygon_area(double radius) { return sides / 2.0 * radius * radius * sine(2 * pi / sides); }

/// A tube of height 10. The triangles of its flat ends use chords that pass near the hole.
Mesh tube(double outer, double inner) {
    Mesh mesh;
    for (const auto& ring : {ring_at(outer, 0), ring_at(inner, 0), ring_at(outer, 10), ring_at(inner, 10)})
        mesh.positions.insert(mesh.positions.end(), ring.begin(), ring.end());
    const auto at = [](Index ring, Index i) { return ring * sides + i % sides; };
    const auto add = [&](Index a, Index b, Index c) { mesh.corners.insert(mesh.corners.end(), {a, b, c}); };
    constexpr Index skew = 4; // 45 degrees
    for (Index i = 0; i < sides; ++i) {
        add(at(0, i), at(0, i + 1), at(2, i + 1));
        add(at(0, i), at(2, i + 1), at(2, i));
        add(at(1, i), at(3, i + 1), at(1, i + 1));
        add(at(1, i), at(3, i), at(3, i + 1));
        add(at(3, i), at(2, i + skew), at(3, i + 1));
        add(at(2, i + skew), at(2, i + skew + 1), at(3, i + 1));
        add(at(1, i), at(1, i + 1), at(0, i + skew));
        add(at(0, i + skew), at(1, i + 1), at(0, i + skew + 1));
    }
    return mesh;
}

Mesh turned_in_space(Mesh mesh) {
    for (Vec3& p : mesh.positions)
        p = {(2 * p.x - p.y + 2 * p.z) / 3, (2 * p.x + 2 * p.y - p.z) / 3, (-p.x + 2 * p.y + 2 * p.z) / 3};
    return mesh;
}

/// The solid must have this Euler number, and no defect may be left.
void check_sound(const ThickenResult& r, std::int64_t euler, double volume) {
    CHECK(r.turned == 0);
    CHECK(r.self_intersections == std::size_t{0});
    CHECK(r.buried == 0);
    CHECK(broken_invariants(r.mesh).empty());
    const Properties p = inspect(r.mesh);
    CHECK(p.closed);
    CHECK(p.oriented);
    CHECK(p.euler == euler);
    CHECK(p.isolated_vertices == 0);
    CHECK(test::volume(r.mesh) == Approx(volume));
}

} // namespace

TEST_CASE("thicken of a tube triangulates its flat ends again", "[geometry]") {
    const double whole = (polygon_area(5) - polygon_area(3)) * 10;
    for (const double t : {0.1, 0.3, 0.5, 0.8, 0.95}) {
        CAPTURE(t);
        const double far = t / cosine(pi / sides); // how far the corners of a ring move
        const double cavity = (polygon_area(5 - far) - polygon_area(3 + far)) * (10 - 2 * t);
        check_sound(thicken(tube(5, 3), {.thickness = t}), 0, whole - cavity);
        check_sound(thicken(turned_in_space(tube(5, 3)), {.thickness = t}), 0, whole - cavity);
        const double around = (polygon_area(5 + far) - polygon_area(3 - far)) * (10 + 2 * t);
        check_sound(thicken(tube(5, 3), {.thickness = t, .side = ThickenSide::outward}), 0, around - whole);
    }
    CHECK(thicken(tube(5, 3), {.thickness = 1.1}).filled == 1); // no cavity has room
}

TEST_CASE("thicken drops the inner vertices of flat faces that the moved outline passes", "[geometry]") {
    Mesh cube = touching_sides(8); // sides of 8 by 8 squares
    merge_vertices(cube, lowest_at_place(cube));
    check_sound(thicken(cube, {.thickness = 1.25, .resolve = true}), 4, 8 * 8 * 8 - 5.5 * 5.5 * 5.5);
    check_sound(thicken(cube, {.thickness = 2, .resolve = true}), 4, 8 * 8 * 8 - 4 * 4 * 4);
}

TEST_CASE("thicken judges concave polygons by their moved outline", "[geometry]") {
    Mesh bracket; // its ends are polygons of 2 * (n + 1) corners
    const int n = sides / 2;
    for (const double z : {0.0, 10.0}) {
        const auto outer = ring_at(5, z), inner = ring_at(3, z);
        bracket.positions.insert(bracket.positions.end(), outer.begin(), outer.begin() + n + 1);
        bracket.positions.insert(bracket.positions.end(), inner.rend() - n - 1, inner.rend());
    }
    const Index size = 2 * (n + 1);
    bracket.face_offsets = {0};
    const auto end_face = [&] { bracket.face_offsets.push_back(static_cast<Index>(bracket.corners.size())); };
    for (Index i = size; i-- > 0;) bracket.corners.push_back(i);
    end_face();
    for (Index i = 0; i < size; ++i) bracket.corners.push_back(size + i);
    end_face();
    for (Index i = 0; i < size; ++i) {
        const Index j = (i + 1) % size;
        bracket.corners.insert(bracket.corners.end(), {i, j, size + j, size + i});
        end_face();
    }
    for (const double t : {0.2, 0.4, 0.5}) {
        CAPTURE(t);
        const ThickenResult r = thicken(bracket, {.thickness = t});
        CHECK(r.turned == 0);
        CHECK(r.self_intersections == std::size_t{0});
        CHECK(inspect(r.mesh).euler == 4);
    }
}

TEST_CASE("thicken does not count touching faces as intersections", "[geometry]") {
    Mesh cubes = shapes::cube();
    append(cubes, moved(shapes::cube(), {1, 1, 0})); // they share an edge
    const ThickenResult r = thicken(cubes, {.thickness = 0.1, .resolve = true});
    CHECK_FALSE(r.resolved);
    check_sound(r, 8, 2 * (1 - 0.8 * 0.8 * 0.8));
}

TEST_CASE("thicken names a cavity of another topology than its surface", "[geometry]") {
    Mesh dumbbell; // two boxes and a neck, as an outline that is swept along z
    const double outline[][2] = {{0, 0},  {4, 0}, {4, 1.5}, {6, 1.5}, {6, 0}, {10, 0},
                                 {10, 4}, {6, 4}, {6, 2.5}, {4, 2.5}, {4, 4}, {0, 4}};
    const Index n = 12;
    for (const double z : {0.0, 4.0})
        for (const auto& [x, y] : outline) dumbbell.positions.push_back({x, y, z});
    dumbbell.face_offsets = {0};
    const auto end_face = [&] {
        dumbbell.face_offsets.push_back(static_cast<Index>(dumbbell.corners.size()));
    };
    for (Index i = n; i-- > 0;) dumbbell.corners.push_back(i);
    end_face();
    for (Index i = 0; i < n; ++i) dumbbell.corners.push_back(n + i);
    end_face();
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        dumbbell.corners.insert(dumbbell.corners.end(), {i, j, n + j, n + i});
        end_face();
    }
    dumbbell = triangles_of(dumbbell);
    CHECK_FALSE(thicken(dumbbell, {.thickness = 0.2, .resolve = true}).changed_topology);
    const ThickenResult r = thicken(dumbbell, {.thickness = 0.6, .resolve = true}); // no room in the neck
    REQUIRE(r.resolved);
    REQUIRE(r.changed_topology);
    CHECK(r.changed_topology->surface == 2);
    CHECK(r.changed_topology->side == 4);
    check_sound(r, 6, 136 - 2 * 2.8 * 2.8 * 2.8);
}

// Tests thicken on closed surfaces whose walls do not fit inside.
#include "support/catch.hpp"
#include "support/measure.hpp"
#include "support/meshes.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/thicken/moved_surface.hpp"
#include "geometry/thicken/thicken.hpp"
#include "mesh/transform.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

Mesh scaled(Mesh mesh, const Vec3& by) {
    for (Vec3& p : mesh.positions) p = {p.x * by.x, p.y * by.y, p.z * by.z};
    return mesh;
}

Mesh reversed(Mesh mesh) {
    for (Index f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin(f), mesh.corners.begin() + mesh.face_end(f));
    return mesh;
}

Mesh both(Mesh a, const Mesh& b) {
    const auto base = static_cast<Index>(a.vertex_count());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const Index c : b.corners) a.corners.push_back(base + c);
    return a;
}

/// Corners that are cut off equally far from all faces.
Mesh tetrahedron() {
    Mesh mesh;
    mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.corners = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    return mesh;
}

/// A ball with a waist.
Mesh dumbbell() {
    Mesh mesh = shapes::icosphere(4);
    for (Vec3& p : mesh.positions) {
        const double waist = 0.15 + p.x * p.x;
        p = {3 * p.x, p.y * waist, p.z * waist};
    }
    return mesh;
}

bool is_sound(const ThickenResult& r) {
    return r.turned == 0 && r.buried == 0 && r.self_intersections == std::size_t{0};
}

} // namespace

TEST_CASE("thicken of a box is the box without the smaller one, or the box", "[geometry]") {
    std::size_t filled = 0;
    for (const Vec3& size : {Vec3{10, 1, 1}, Vec3{1, 1, 1}, Vec3{4, 4, 1}, Vec3{3, 2, 1}, Vec3{1, 7, 2}})
        for (const double t : {0.1, 0.3, 0.45, 0.5, 0.55, 0.6, 0.9, 1.0, 1.1, 2.0, 5.0, 20.0})
            for (const Mesh& cube : {shapes::cube(), shapes::quad_cube()})
                for (const double mirror : {1.0, -1.0}) {
                    const Mesh box = scaled(cube, size);
                    Transform to_world;
                    to_world.m[0][0] = mirror;
                    const auto r = thicken(box, {.thickness = t, .to_world = to_world});
                    const Vec3 box_size = box.bounds().max - box.bounds().min;
                    const auto left = [&](double x) { return std::max(0.0, x - 2 * t); };
                    const double cavity = left(box_size.x) * left(box_size.y) * left(box_size.z);
                    INFO(size.x << ' ' << size.y << ' ' << size.z << ' ' << t);
                    CHECK(is_sound(r));
                    CHECK(test::volume(r.mesh) == Approx(box_size.x * box_size.y * box_size.z - cavity));
                    CHECK(r.filled == (cavity == 0 ? 1 : 0));
                    CHECK(r.wall.has_value() == (cavity > 0));
                    CHECK(inspect(r.mesh).components == (cavity > 0 ? 2 : 1));
                    filled += r.filled;
                }
    CHECK(filled > 0);
}

TEST_CASE("thicken of a tetrahedron leaves a similar one, or none", "[geometry]") {
    const Mesh solid = tetrahedron();
    const double volume = test::volume(solid), radius = 3 * volume / test::area(solid); // of the ball in it
    for (const double part : {0.2, 0.7, 0.95, 1.05, 1.5, 4.0}) {
        const auto r = thicken(solid, {.thickness = part * radius, .miter_limit = 100});
        const double left = std::max(0.0, 1 - part);
        CHECK(is_sound(r));
        CHECK(test::volume(r.mesh) == Approx(volume * (1 - left * left * left)));
        CHECK(r.filled == (part > 1 ? 1 : 0));
    }
}

TEST_CASE("thicken fills a ball that is thinner than its wall, on the side that has no room", "[geometry]") {
    const Mesh ball = shapes::icosphere(2);
    const double volume = test::volume(ball);
    auto r = thicken(ball, {.thickness = 1.2});
    CHECK((is_sound(r) && r.filled == 1));
    CHECK(test::volume(r.mesh) == Approx(volume));
    r = thicken(reversed(ball), {.thickness = 1.2, .side = ThickenSide::outward}); // a bubble, filled
    CHECK((is_sound(r) && r.filled == 1));
    CHECK(test::volume(r.mesh) == Approx(volume));
    r = thicken(ball, {.thickness = 1.2, .side = ThickenSide::centred});
    CHECK((is_sound(r) && r.filled == 0));
    CHECK(test::volume(r.mesh) == Approx(volume * (1.6 * 1.6 * 1.6 - 0.4 * 0.4 * 0.4)).epsilon(0.02));
    r = thicken(ball, {.thickness = 1.2, .side = ThickenSide::outward});
    CHECK((is_sound(r) && r.filled == 0));
    // A component that becomes filled, next to a hollow component: each is handled separately.
    Mesh large = scaled(ball, {3, 3, 3});
    for (Vec3& p : large.positions) p.x += 10;
    r = thicken(both(ball, large), {.thickness = 1.2});
    CHECK((is_sound(r) && r.filled == 1));
    CHECK(inspect(r.mesh).components == 3);
    CHECK(r.wall->thinnest == Approx(1.2).epsilon(0.1));
}

TEST_CASE("thicken says where walls that are not filled fold over", "[geometry]") {
    const auto waist = thicken(dumbbell(), {.thickness = 0.3}); // its ends have room
    CHECK(waist.filled == 0);
    CHECK(waist.turned > 0);
    REQUIRE(waist.first_turned);
    CHECK(std::abs(waist.first_turned->x) < 1.5);
    const auto thin = thicken(dumbbell(), {.thickness = 0.01});
    CHECK(is_sound(thin));
    Mesh trough = shapes::icosphere(3); // an open half has no inside to fill
    std::vector<Index> below;
    for (Index f = 0; f < trough.face_count(); ++f)
        if (trough.point(3 * f).z < 0)
            for (Index c = 3 * f; c < 3 * f + 3; ++c) below.push_back(trough.corners[c]);
    trough.corners = below;
    const auto bowl = thicken(trough, {.thickness = 1.2});
    CHECK(bowl.turned > trough.face_count() * 95 / 100); // except for the uneven border
    CHECK(bowl.filled == 0);
}

TEST_CASE("thicken tells of walls that lie within others", "[geometry]") {
    const Mesh ball = shapes::icosphere(2);
    const Mesh hollow = both(ball, reversed(scaled(ball, {0.8, 0.8, 0.8})));
    CHECK(is_sound(thicken(hollow, {.thickness = 0.05})));
    const auto r = thicken(hollow, {.thickness = 0.3}); // each shell's wall passes the other's front
    CHECK(r.self_intersections == std::size_t{0});
    CHECK(r.buried > 0);
}

TEST_CASE("turned_faces: a face that shrank to nothing on the way is turned", "[geometry]") {
    const auto turned = [](const Mesh& mesh, const Vec3& by) {
        const auto flags = turned_faces(mesh, scaled(mesh, by).positions);
        return std::count(flags.begin(), flags.end(), 1);
    };
    const Mesh sheet = shapes::grid(2, 2);
    CHECK(turned(sheet, {0.1, 0.1, 1}) == 0);
    CHECK(turned(sheet, {-0.1, 1, 1}) == 8);    // in one direction: the area has another sign
    CHECK(turned(sheet, {-0.1, -0.1, 1}) == 8); // in both: it has not
    CHECK(turned(sheet, {0, 1, 1}) == 8);
    const Mesh polygons = shapes::quad_cube();
    CHECK(turned(polygons, {-0.1, -0.1, -0.1}) == 6);
    CHECK(turned(polygons, {2, -0.1, 2}) == 4);
}

TEST_CASE("room_inside finds whether a ball fits", "[geometry]") {
    const double far = 1e-3; // a smaller margin counts as no room
    const Mesh ball = shapes::icosphere(3), solid = tetrahedron();
    const double radius = 3 * test::volume(solid) / test::area(solid);
    for (const auto& [mesh, most] : {std::pair(solid, radius), {scaled(solid, {7, 7, 7}), 7 * radius}}) {
        CHECK(room_inside(mesh, most * (1 - 2 * far)) == Room::some);
        CHECK(room_inside(mesh, most * (1 + 2 * far)) == Room::none);
    }
    CHECK(room_inside(ball, 0.9) == Room::some);
    CHECK(room_inside(ball, 1) == Room::none);
    CHECK(room_inside(dumbbell(), 0.3) == Room::some);
    CHECK(room_inside(reversed(ball), 0.3) == Room::none); // its inside is without
}

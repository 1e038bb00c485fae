#include "support/catch.hpp"

#include "geometry/clip/clip.hpp"
#include "geometry/cut/cap_paint.hpp"
#include "geometry/deviation/signed_deviation.hpp"
#include "mesh/shapes.hpp"
#include "support/meshes.hpp"

#include <limits>

using namespace facetmill;

namespace {

Scene scene_with(Mesh mesh) {
    Scene scene;
    scene.parts.emplace_back().mesh = std::move(mesh);
    return scene;
}

FaceTree near_tree(const Mesh& mesh) { return FaceTree(surface_of(mesh), FaceTree::Use::near); }

} // namespace

TEST_CASE("signed distances are positive outside and negative inside", "[geometry]") {
    const FaceTree sphere = near_tree(shapes::icosphere(3));
    Mesh larger = shapes::icosphere(3), smaller = larger;
    for (Vec3& p : larger.positions) p = p * 1.25;
    for (Vec3& p : smaller.positions) p = p * 0.5;
    const auto outside = signed_deviation(scene_with(larger), sphere);
    CHECK(outside.high == Approx(0.25).epsilon(0.02));
    CHECK(outside.low == 0);
    CHECK(outside.mean == Approx(0.25).epsilon(0.02));
    CHECK(outside.worst_distance == outside.high);
    const auto inside = signed_deviation(scene_with(smaller), sphere);
    CHECK(inside.low < -0.48);
    CHECK(inside.high == 0);
    CHECK(inside.samples.size() == 10000);
    const Attribute* distance = inside.scene.parts[0].mesh.find(distance_attribute, Domain::vertex);
    REQUIRE(distance);
    CHECK(distance->value(0, 0) < -0.4);
}

TEST_CASE("of many vertices some are looked up, and the farthest all the same", "[geometry]") {
    const FaceTree flat = near_tree(shapes::grid(1, 1));
    Mesh sheet = shapes::grid(1000, 1000); // several to a cell
    for (Vec3& p : sheet.positions) p = {p.x / 1000, p.y / 1000, 0};
    const std::size_t peak = 450000;
    sheet.positions[peak].z = 0.02;
    const auto found = signed_deviation(scene_with(sheet), flat, {.vertices = 2000, .samples = 100});
    CHECK(found.looked_up < sheet.vertex_count() / 2);
    CHECK(std::abs(found.worst_distance) == Approx(0.02).epsilon(1e-5));
    CHECK(length(found.worst - sheet.positions[peak]) < 1e-9);
}

TEST_CASE("what happens inside a large face is seen", "[geometry]") {
    const FaceTree ball = near_tree(shapes::icosphere(4));
    Mesh disc; // through the middle of the ball, its rim on the ball
    disc.positions = {{1, 0, 0}, {-0.5, 0.75, 0}, {-0.5, -0.75, 0}};
    disc.corners = {0, 1, 2};
    const auto found = signed_deviation(scene_with(disc), ball);
    CHECK(found.is_cut);
    CHECK(found.low < -0.9);
    const Mesh& shown = found.scene.parts[0].mesh;
    CHECK(shown.face_count() == 24 * 24);
    const Attribute* distance = shown.find(distance_attribute, Domain::vertex);
    REQUIRE(distance);
    CHECK(distance->size() == shown.vertex_count());
    double lowest = 0;
    for (std::size_t v = 0; v < distance->size(); ++v) lowest = std::min(lowest, distance->value(v, 0));
    CHECK(lowest < -0.9);
    double area = 0;
    for (Index f = 0; f < shown.face_count(); ++f)
        area +=
            cross(shown.point(3 * f + 1) - shown.point(3 * f), shown.point(3 * f + 2) - shown.point(3 * f))
                .z /
            2;
    CHECK(area == Approx(1.125));
}

TEST_CASE("distances of nothing, of points and of what is not finite", "[geometry]") {
    const FaceTree sphere = near_tree(shapes::icosphere(1));
    CHECK_FALSE(signed_deviation(Scene{}, sphere).any());
    CHECK_FALSE(signed_deviation(scene_with(shapes::icosphere(1)), FaceTree(Surface{})).any());
    Mesh points;
    points.positions = {{3, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
    const auto found = signed_deviation(scene_with(points), sphere);
    CHECK(found.any());
    CHECK(found.worst.x == 3);
    CHECK(found.samples.size() == 2);
}

TEST_CASE("what closes a cut is not measured, unless the reference has it", "[geometry]") {
    const Mesh ball = shapes::icosphere(4);
    ClipSettings settings;
    settings.planes = {{{0, 0, 1}, {0, 0, 0.25}}};
    settings.cap = settings.cap_numbers = true;
    const ClipResult half = clip(ball, settings);
    REQUIRE(half.cap_faces > 0);
    Mesh isolated = half.front;
    isolated.positions.push_back({0, 0, 3});
    for (const Mesh& mesh : {half.front, isolated}) {
        const Scene scene = scene_with(mesh);
        CHECK(last_cap(scene) == 1);
        const auto all = signed_deviation(scene, near_tree(ball));
        CHECK(all.caps == 0);
        CHECK(all.low < -0.7); // inside the ball, the cap's centre is at the same distance from it
        const auto found = signed_deviation(scene, near_tree(ball), {.last_cap = 0});
        CHECK(found.caps == half.cap_faces);
        CHECK(found.low == Approx(0).margin(1e-12)); // cut edges lie on the ball's faces, except for rounding
        CHECK(found.high ==
              (mesh.vertex_count() > half.front.vertex_count() ? Approx(2) : Approx(0).margin(1e-12)));
        REQUIRE(found.scene.parts.size() == 2); // the caps are visible
        CHECK(found.scene.parts[1].mesh.face_count() == half.cap_faces);
        CHECK(found.scene.parts[1].mesh.attributes.empty());
    }
    // A boolean operation numbers faces from another part but gives them no group, so they are measured.
    Mesh taken = half.front;
    taken.drop(group_attribute, Domain::face);
    CHECK(signed_deviation(scene_with(taken), near_tree(ball), {.last_cap = 0}).caps == 0);
    const Scene scene = scene_with(half.front);
    const auto itself = signed_deviation(scene, near_tree(half.front), {.last_cap = last_cap(scene)});
    CHECK(itself.caps == 0);
    CHECK(itself.scene.parts.size() == 1);
}

#include "report/page_failures.hpp"
#include "support/catch.hpp"

#include "mesh/shapes.hpp"
#include "mesh/transform.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;

namespace {

/// A cube in the middle of another, twelve triangles each, in two parts or in a single part.
Scene cube_in_cube() {
    Scene scene = test::scene_of(shapes::cube());
    scene.parts[0].name = "inner";
    Part outer = scene.parts[0];
    outer.name = "outer";
    for (Vec3& p : outer.mesh.positions) p = p * 3.0 - Vec3{1, 1, 1};
    scene.parts.push_back(outer);
    return scene;
}

report::Check check_of_face(const std::string& part, std::size_t face, const Vec3& at) {
    report::Check check;
    check.name = "self_intersections";
    check.passed = false;
    report::EvidenceEntry entry;
    entry.name = part;
    entry.face = face;
    entry.at = at;
    check.evidence.emplace();
    check.evidence->push_back(entry);
    return check;
}

/// Whether the middle of the picture of the close view is red.
bool is_red_in_the_middle(const Scene& scene, const report::Check& check) {
    PictureSettings settings;
    settings.attribute = report::failing_attribute;
    settings.range = {ColourRange::Kind::given, -1, 1, true};
    const Scene marked = report::with_failing_faces(scene, check);
    auto close = report::close_view(marked, check, settings);
    close.settings.at = check.evidence->front().at;
    close.settings.camera = camera_of(marked, close.settings);
    const Picture picture = picture_of(close.scene, close.settings);
    const std::uint8_t* pixel = &picture.rgba[4 * (180 * 480 + 240)];
    return pixel[3] == 255 && pixel[0] > 2 * pixel[1];
}

Vec3 middle_of(const Part& part, Index face) {
    return (part.mesh.point(3 * face) + part.mesh.point(3 * face + 1) + part.mesh.point(3 * face + 2)) / 3;
}

} // namespace

TEST_CASE("a failing face inside of others is seen in the close view", "[pipeline]") {
    const Scene scene = cube_in_cube();
    REQUIRE(scene.parts[0].mesh.all_triangles());
    for (Index f = 0; f < 12; ++f) {
        const auto check = check_of_face("inner", f, middle_of(scene.parts[0], f));
        CHECK(is_red_in_the_middle(scene, check));
        // Only geometry in front of it is removed: one side of the outer cube.
        const auto close = report::close_view(report::with_failing_faces(scene, check), check, {});
        CHECK(close.scene.parts[0].mesh.face_count() == 12);
        CHECK(close.scene.parts[1].mesh.face_count() == 10);
    }
}

TEST_CASE("where nothing hides a failing face, all of the scene is in the close view", "[pipeline]") {
    const Scene scene = cube_in_cube();
    for (Index f = 0; f < 12; ++f) {
        const auto check = check_of_face("outer", f, middle_of(scene.parts[1], f));
        CHECK(is_red_in_the_middle(scene, check));
        CHECK(report::close_view(report::with_failing_faces(scene, check), check, {}).scene.face_count() ==
              24);
    }
}

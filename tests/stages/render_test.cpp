#include "support/catch.hpp"

#include "io/outputs/outputs.hpp"
#include "mesh/shapes.hpp"
#include "support/failure.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

using namespace facetmill;
using test::options;
using test::problems_of;
using test::run_stage;
using test::scene_of;

namespace {

/// Big-endian, as the header of a PNG has it.
std::uint32_t number_at(const io::Input& bytes, std::size_t at) {
    std::uint32_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) n = n << 8 | std::to_integer<std::uint32_t>(bytes.bytes()[at + i]);
    return n;
}

} // namespace

TEST_CASE("render writes a PNG and passes the scene on", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto run = run_stage(
        "render",
        options({{"path", (folder.path() / "a.png").string()}, {"width", "320"}, {"height", "240"}}),
        scene_of(shapes::cube()));
    CHECK_FALSE(run.scene.parts[0].changed);
    REQUIRE(run.state->outputs.files().size() == 1);
    const io::Input bytes = run.state->outputs.staged(*run.state->outputs.files()[0]);
    CHECK(number_at(bytes, 0) == 0x89504e47);
    CHECK(number_at(bytes, 16) == 320);
    CHECK(number_at(bytes, 20) == 240);
    CHECK(run.record.result["faces"] == 12);
    CHECK(run.record.result["width"] == 320);
    CHECK(run.record.result["pixels_per_unit"].get<double>() > 100);
    CHECK(run.warnings().empty());
    REQUIRE(run.state->record.outputs.size() == 1);
    CHECK(run.state->record.outputs[0].path == (folder.path() / "a.png").string());
    CHECK(run.state->record.outputs[0].bytes == bytes.bytes().size());
    CHECK(run.state->record.outputs[0].sha256.size() == 64);
}

TEST_CASE("both shadings make a picture of twice the width", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto run = run_stage("render",
                               options({{"path", (folder.path() / "b.png").string()},
                                        {"width", "100"},
                                        {"height", "80"},
                                        {"shading", "beside"}}),
                               scene_of(shapes::cube()));
    CHECK(run.record.result["width"] == 200);
    CHECK(run.record.result["height"] == 80);
}

TEST_CASE("another file in another unit or up axis is told", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto told = [&](const Vec3& size, Unit unit, Unit others) {
        const auto other = folder / "other.off";
        Scene large = scene_of(shapes::cube(), others);
        for (Vec3& p : large.parts[0].mesh.positions) p = {p.x * size.x, p.y * size.y, p.z * size.z};
        io::write_now(other, io::codec_for(other)->write(large, {}).files.front().bytes);
        Scene scene = scene_of(shapes::cube(), unit);
        for (Vec3& p : scene.parts[0].mesh.positions) p.z *= 3;
        const auto run = run_stage(
            "render", options({{"path", (folder / "p.png").string()}, {"with", other.string()}}), scene);
        std::string all;
        for (const auto& w : run.record.warnings)
            if (w.id == "W-UNITS" || w.id == "W-CONVENTION") all += w.id + " " + w.hint;
        return all;
    };
    const Unit unknown = Unit::unknown;
    CHECK(told({1, 1, 3}, unknown, unknown).empty());
    CHECK(told({1, 1, 2}, unknown, unknown).empty()); // another shape
    CHECK(told({10, 10, 30}, unknown, unknown).find("use --unit cm,mm") != std::string::npos);
    CHECK(told({1000, 1000, 3000}, unknown, unknown).starts_with("W-CONVENTION"));
    CHECK(told({0.001, 0.001, 0.003}, Unit::m, unknown).starts_with("W-CONVENTION"));
    CHECK(told({1, 3, 1}, unknown, unknown).starts_with("W-CONVENTION")); // rotated
    // Another shape and far apart in size.
    CHECK(told({1000, 1000, 1000}, unknown, unknown).starts_with("W-UNITS use transform: {scale: "));
}

TEST_CASE("another file is drawn beside the scene by one camera", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto other = folder / "other.off";
    Scene twice = scene_of(shapes::cube());
    for (Vec3& p : twice.parts[0].mesh.positions) p = p * 2 + Vec3{5, 0, 0};
    io::write_now(other, io::codec_for(other)->write(twice, {}).files.front().bytes);
    const auto picture = [&](const std::map<std::string, std::string>& more) {
        std::vector<std::pair<std::string, std::string>> all{
            {"path", (folder / "p.png").string()}, {"width", "80"}, {"height", "60"}, {"view", "front"}};
        all.insert(all.end(), more.begin(), more.end());
        return run_stage("render", options(all), scene_of(shapes::cube()));
    };
    const auto alone = picture({}), both = picture({{"with", other.string()}});
    CHECK(both.record.result["width"] == 160);
    CHECK(both.record.result["height"] == 60);
    CHECK(both.record.result["faces"] == 24);
    // A camera of 7 units' width shows the cube from 0 to 1 and the cube from 5 to 7.
    CHECK(both.record.result["pixels_per_unit"].get<double>() == Approx(0.92 * 80 / 7));
    CHECK(alone.record.result["pixels_per_unit"].get<double>() == Approx(0.92 * 60));
    REQUIRE(both.state->record.inputs.size() == 1);
    CHECK(both.state->record.inputs[0].path == other.string());
    const auto shades = picture({{"with", other.string()}, {"shading", "beside"}});
    CHECK(shades.record.result["width"] == 160);
    CHECK(shades.record.result["height"] == 120);
    CHECK(test::failure([&] {
              picture({{"with", (folder / "none.off").string()}});
          }).find("E-FILE") != std::string::npos);
    CHECK(problems_of("render", options({{"path", "a.png"}, {"with", "b.off"}, {"perspective", "30"}}))
              .find("perspective") != std::string::npos);
}

TEST_CASE("several views make one picture", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto views = [&](const std::string& names) {
        return "{path: " + (folder.path() / "v.png").string() + ", width: 80, height: 60, views: " + names +
               "}";
    };
    const auto size = [&](const std::string& names) {
        const auto run = run_stage("render", views(names), scene_of(shapes::cube()));
        return std::pair(run.record.result["width"].get<int>(), run.record.result["height"].get<int>());
    };
    CHECK(size("turntable") == std::pair(320, 120));
    CHECK(size("[front, left, top]") == std::pair(240, 60));
    CHECK(size("[front, left, top, turntable]") == std::pair(320, 180));
    CHECK(problems_of("render", options({{"path", "a.png"}, {"views", "turntabel"}})) ==
          "E-CHOICE render: view 'turntabel' does not exist | did you mean 'turntable'?");
    CHECK(problems_of(
              "render",
              options({{"path", "a.png"}, {"views", "turntable"}, {"width", "8000"}, {"height", "8000"}}))
              .starts_with("E-RANGE render: 8 views of 8000 x 8000 pixels"));
}

TEST_CASE("the range of colours is said in the result", "[stages]") {
    const test::TemporaryDirectory folder;
    Scene scene = scene_of(shapes::cube());
    std::vector<float> values(8, 1.0f);
    values[0] = 3;
    scene.parts[0].mesh.attributes.push_back({"heat", Domain::vertex, Role::generic, 1, false, values});
    const auto result = [&](const std::string& range) {
        const std::string path = (folder.path() / "r.png").string();
        return run_stage("render", "{path: " + path + ", attribute: heat, range: " + range + "}", scene)
            .record.result;
    };
    CHECK(result("auto")["range"] == Json::array({1.0, 3.0}));
    CHECK(result("[0, 2]")["range"] == Json::array({0.0, 2.0}));
    CHECK(result("[0, 2]")["all_values"] == Json::array({1.0, 3.0}));
    CHECK(result("all")["percentiles"] == false);
    for (const char* wrong : {"few", "[1]", "[2, 1]", "[1, x]"})
        CHECK(problems_of("render", options({{"path", "a.png"}, {"range", wrong}})).starts_with("E-TYPE"));
}

TEST_CASE("views beside a legend have one scale, however small a direction is", "[stages]") {
    const test::TemporaryDirectory folder;
    Mesh box = shapes::cube();
    for (Vec3& p : box.positions) p.x *= 3;
    Scene scene = scene_of(box);
    scene.up = UpAxis::y;
    scene.parts[0].mesh.attributes.push_back(
        {"heat", Domain::vertex, Role::generic, 1, false, std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7}});
    const auto scale = [&](const std::string& rest) {
        const std::string path = (folder.path() / "v.png").string();
        return run_stage("render",
                         "{path: " + path + ", width: 300, height: 300, attribute: heat, " + rest + "}",
                         scene)
            .record.result["pixels_per_unit"]
            .get<double>();
    };
    // The record has the scale of the first picture, the end of the box, which alone would have a larger
    // scale.
    CHECK(scale("view: left") > 1.5 * scale("view: front"));
    CHECK(scale("views: [left, front]") == Approx(scale("view: front")));
    CHECK(scale("from: [1e-200, 0, 0]") == Approx(scale("from: [1, 0, 0]")));
    CHECK(scale("from: [1e200, 0, 0]") == Approx(scale("from: [1, 0, 0]")));
}

TEST_CASE("render says what it was not given", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto run =
        run_stage("render", options({{"path", (folder.path() / "c.png").string()}}), scene_of({}));
    CHECK(run.record.result["pixels_per_unit"] == 0.0);
    CHECK(
        problems_of("render", options({{"path", "a.jpg"}})) ==
        "E-PICTURE render: images are PNG, and 'a.jpg' does not end in .png | for example render: view.png");
    CHECK(problems_of("render", options({{"path", "a.png"}, {"from", "0,0,0"}}))
              .starts_with("E-DIRECTION render: 'from' needs a direction"));
    CHECK(problems_of("render", options({{"path", "a.png"}, {"from", "0,0,1"}, {"view", "top"}}))
              .starts_with("E-CONFLICT"));
    CHECK(problems_of("render", options({{"path", "a.png"}, {"width", "100000"}})).starts_with("E-RANGE"));
    CHECK(problems_of("render", options({{"path", "a.png"}, {"height", "0"}})).starts_with("E-RANGE"));
    CHECK(problems_of("render", options({})).starts_with("E-MISSING"));
}

namespace {

/// As a map, in which the attribute is drawn into a file of the folder.
std::string drawing_options(const test::TemporaryDirectory& folder, const std::string& rest) {
    return "{path: " + (folder / "m.png").string() + ", width: 200, height: 150, " + rest + "}";
}

} // namespace

TEST_CASE("render measures an attribute that no part has", "[stages]") {
    const test::TemporaryDirectory folder;
    Mesh ball = shapes::icosphere(3);
    for (Vec3& p : ball.positions) p = p * 2;
    const auto run =
        run_stage("render", drawing_options(folder, "attribute: thickness"), scene_of(ball, Unit::mm));
    const Json& result = run.record.result;
    CHECK(result["attribute"] == "wall_thickness");
    CHECK(result["measured"] == true);
    CHECK(result["missing"] == 0);
    CHECK(result["all_values"][0].get<double>() == Approx(4).epsilon(0.03));
    CHECK(run.mesh().attributes.empty()); // the scene passes on unchanged
    CHECK_FALSE(run.scene.parts[0].changed);
    const auto equal =
        run_stage("render", drawing_options(folder, "attribute: min_angle"), scene_of(shapes::octahedron()));
    CHECK(equal.record.said.at(0).find("min_angle 60 everywhere") != std::string::npos);
    // An attribute of the scene has priority.
    Scene own = scene_of(shapes::cube());
    own.parts[0].mesh.attributes.push_back(
        {"thickness", Domain::vertex, Role::generic, 1, false, std::vector<float>{0, 1, 2, 3, 4, 5, 6, 7}});
    const auto as_is = run_stage("render", drawing_options(folder, "attribute: thickness"), own);
    CHECK(as_is.record.result["measured"] == false);
    CHECK(as_is.record.result["range"] == Json::array({0.0, 7.0}));
    // Signed numbers have a range as wide either way.
    const auto bends =
        run_stage("render", drawing_options(folder, "attribute: curvature"), scene_of(shapes::torus(24, 12)));
    const Json& range = bends.record.result["range"];
    CHECK(range[0].get<double>() == -range[1].get<double>());
}

TEST_CASE("deviation of render is that of each mesh from the other", "[stages]") {
    const test::TemporaryDirectory folder;
    const auto other = folder / "other.off";
    io::write_now(other, io::codec_for(other)->write(scene_of(shapes::icosphere(3)), {}).files.front().bytes);
    Mesh large = shapes::cube(); // around the ball, its corners far off; cut for the picture
    for (Vec3& p : large.positions) p = (p - Vec3{0.5, 0.5, 0.5}) * 2;
    const auto run = run_stage(
        "render", drawing_options(folder, "attribute: deviation, with: " + other.string()), scene_of(large));
    const Json& result = run.record.result;
    CHECK(result["all_values"][1].get<double>() == Approx(std::sqrt(3.0) - 1).epsilon(0.02));
    CHECK(result["all_values"][0].get<double>() < 0.02); // the middles of its faces touch the ball
    CHECK(result["faces"] == 12 + 1280);                 // as they were before faces were cut
    const auto whole = run_stage(
        "render", drawing_options(folder, "edges: all, attribute: deviation, with: " + other.string()),
        scene_of(large));
    const Json& corners = whole.record.result["all_values"]; // alone, all of them as far
    CHECK(corners[0].get<double>() == Approx(corners[1].get<double>()).epsilon(1e-6));
}

TEST_CASE("what can be neither drawn nor measured is told with what can", "[stages]") {
    const test::TemporaryDirectory folder;
    Scene scene = scene_of(shapes::uv_cube(), Unit::mm);
    const auto said = [&](const std::string& rest) {
        return test::refusal_of("render", drawing_options(folder, rest), scene);
    };
    CHECK(said("attribute: warmth").find("no part has an attribute 'warmth'") != std::string::npos);
    CHECK(said("attribute: warmth").find("the scene has ") != std::string::npos);
    CHECK(said("attribute: warmth").find("NORMAL") != std::string::npos);
    CHECK(said("attribute: warmth").find("; render can measure min_angle, ") != std::string::npos);
    CHECK(said("attribute: thicknes").find("did you mean 'thickness'?") != std::string::npos);
    CHECK(said("attribute: failed").find("validate: {mark: failed.ply}") != std::string::npos);
    CHECK(said("attribute: thickness, unit: m").find("wall_thickness is measured in mm, not in m") !=
          std::string::npos);
    const auto sheet =
        run_stage("render", drawing_options(folder, "attribute: thickness"), scene_of(shapes::grid(2, 2)));
    CHECK(sheet.warnings() == std::vector<std::string>{"W-NO-VALUE"});
    CHECK(sheet.record.result["missing"] == 8);
}

TEST_CASE("a stray face that makes the rest small is told, and what shows it", "[stages]") {
    const test::TemporaryDirectory folder;
    Scene scene = scene_of(shapes::icosphere(3));
    Mesh stray = shapes::tetrahedron();
    for (Vec3& p : stray.positions) p = p + Vec3{0, 4e4, 0};
    append(scene.parts[0].mesh, stray);
    const auto run = run_stage("render", drawing_options(folder, "view: front"), scene);
    REQUIRE(run.warnings() == std::vector<std::string>{"W-FAR"});
    CHECK(run.record.warnings[0].message.ends_with(
        " pixels wide in the picture, because another object is far away"));
    CHECK(run.record.warnings[0].hint.starts_with("use render: {path: near.png, at: ["));
    CHECK(
        run_stage("render", drawing_options(folder, "zoom: 10000, at: [0, 0, 0]"), scene).warnings().empty());
    CHECK(run_stage("render", drawing_options(folder, "view: front"), scene_of(shapes::icosphere(3)))
              .warnings()
              .empty());
    // A single point has no extent, so it has no scale.
    Mesh point;
    point.positions = {{1, 2, 3}};
    const auto one = run_stage("render", drawing_options(folder, "view: front"), scene_of(point));
    CHECK(one.record.result["pixels_per_unit"] == 0.0);
    CHECK(one.record.said.at(0).find("a unit") == std::string::npos);
}

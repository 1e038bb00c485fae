// Attribute values that are not numbers: which formats keep them, and where they become 0.
#include "io/attributes.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

using namespace facetmill;

namespace {

/// Four points with a quality and normals, as text.
std::string cloud(const std::string& quality, const std::string& normal = "0 0 1") {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
        "z\nproperty float quality\nproperty float nx\nproperty float ny\nproperty float nz\n"
        "end_header\n";
    for (int i = 0; i < 4; ++i) text += fmt::format("{} 0 0 {} {}\n", i, i == 2 ? quality : "1", normal);
    return text;
}

struct Read {
    Scene scene;
    io::ReadLog log;
};

Read read(const std::string& ply) {
    Read r;
    r.scene = io::read_scene(io::Input::of("a.ply", test::to_bytes(ply)), {}, r.log);
    return r;
}

double quality(const Scene& scene, std::size_t i) {
    const Attribute* a = scene.parts.at(0).mesh.find("quality", Domain::wedge);
    if (!a) a = scene.parts.at(0).mesh.find("_quality", Domain::wedge);
    REQUIRE(a);
    return a->value(i, 0);
}

/// A sheet of nine vertices, one of them with a quality of NaN.
Scene sheet() {
    Mesh mesh = shapes::grid(2, 2);
    std::vector<float> values(9, 1);
    values[4] = NAN;
    mesh.attributes.push_back({"quality", Domain::wedge, Role::generic, 1, false, std::move(values)});
    return test::scene_in_metres(mesh);
}

std::size_t nans(const Scene& scene) {
    std::size_t count = 0;
    const Attribute* a = scene.parts.at(0).mesh.find("quality", Domain::wedge);
    for (std::size_t i = 0; a && i < a->size(); ++i) count += std::isnan(a->value(i, 0));
    return count;
}

} // namespace

TEST_CASE("nan in an attribute without a meaning is read as it is, and written to PLY so", "[io]") {
    for (const char* text : {"nan", "-nan"}) {
        const Read r = read(cloud(text));
        CHECK(r.log.warnings.empty());
        CHECK(std::isnan(quality(r.scene, 2)));
        CHECK_FALSE(std::signbit(quality(r.scene, 2))); // one of the many
        CHECK(quality(r.scene, 1) == 1);
        for (const bool ascii : {false, true}) {
            io::WriteSettings settings;
            settings.ascii = ascii;
            const io::Written written = test::written(r.scene, "ply", settings);
            CHECK(written.warnings.empty());
            CHECK(std::isnan(quality(test::read_bytes(written.files.at(0).bytes, "ply"), 2)));
        }
    }
}

TEST_CASE("infinite values say that there is no number; normals that are none become 0; both are told",
          "[io]") {
    const Read infinite = read(cloud("-inf"));
    CHECK(std::isnan(quality(infinite.scene, 2)));
    REQUIRE(infinite.log.warnings.size() == 1);
    CHECK(infinite.log.warnings[0].id == "W-NAN");
    CHECK(infinite.log.warnings[0].message ==
          "1 value of 'quality' in part 'a' is infinite: read as no value");
    const Read normals = read(cloud("1", "nan 0 1"));
    REQUIRE(normals.log.warnings.size() == 1);
    CHECK(normals.log.warnings[0].message == "4 values of 'NORMAL' in part 'a' are not finite: set to 0");
    CHECK(normals.scene.parts[0].mesh.find("NORMAL", Domain::wedge)->value(0, 0) == 0);
}

TEST_CASE("formats that cannot hold nan get 0, and say of which attribute", "[io]") {
    const Scene scene = sheet();
    for (const auto& [codec, format] :
         {std::pair("glb", "glTF"), std::pair("drc", "Draco"), std::pair("3d-tiles", "a tileset")}) {
        INFO(codec);
        std::size_t told = 0;
        const std::string message = fmt::format(
            "1 value of 'quality' is no number (nan), which {} cannot hold: it is 0 in the file", format);
        for (const Diagnostic& w : test::written(scene, codec).warnings)
            told += w.id == "W-NAN" && w.message == message;
        CHECK(told == 1);
    }
    CHECK(nans(scene) == 1);
    const Scene back = test::read_bytes(test::written(scene, "glb").files.at(0).bytes, "glb");
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i) sum += quality(back, i);
    CHECK(sum == 8);
    io::WriteSettings draco;
    draco.draco.on = true;
    CHECK(test::written(scene, "glb", draco).warnings.at(0).id == "W-NAN");
}

TEST_CASE("what is mixed with no number has none", "[stages]") {
    const Scene scene = sheet();
    // The middle of nine: each of its edges gets a point.
    const auto split = test::run_stage("split", "midpoint", scene);
    const std::size_t at_middle = nans(split.scene);
    CHECK(at_middle > 1);
    CHECK(at_middle < 9);
    CHECK(nans(test::run_stage("clip", "x=0.25", scene).scene) > 0);
    CHECK(nans(test::run_stage("clip", "x=1.5", scene).scene) == 2); // new points at edges of the middle
    const auto clean = test::run_stage("clean", "{}", scene);
    CHECK(nans(clean.scene) == 1);
    const auto tiny = test::run_stage("simplify", "50%", scene);
    for (const Part& part : tiny.scene.parts) CHECK(part.mesh.face_count() > 0);
}

TEST_CASE("parts without an attribute have no number where they are joined with others", "[stages]") {
    Scene scene = test::scene_in_metres(shapes::grid(2, 2));
    scene.parts.push_back(scene.parts.front());
    scene.parts.back().name = "other";
    std::vector<float> values(9, 1);
    values[4] = NAN;
    scene.parts[1].mesh.attributes.push_back({"quality", Domain::wedge, Role::generic, 1, false, values});
    scene.parts[1].mesh.attributes.push_back(
        {"count", Domain::face, Role::generic, 1, false, std::vector<std::int32_t>(8, 7)});
    const Scene merged = test::run_stage("merge", "", scene).scene;
    CHECK(nans(merged) == 10);
    CHECK(merged.parts.at(0).mesh.find("count", Domain::face)->value(0, 0) == 0);
    CHECK(nans(test::read_bytes(test::written(scene, "ply").files.at(0).bytes, "ply")) == 10);
    // A primitive of a glTF is written without the attribute: one value is 0 in it, not ten.
    const io::Written glb = test::written(merged, "glb");
    const auto nan = std::find_if(glb.warnings.begin(), glb.warnings.end(),
                                  [](const Diagnostic& w) { return w.id == "W-NAN"; });
    REQUIRE(nan != glb.warnings.end());
    CHECK(nan->message.starts_with("1 value of 'quality' is no number"));
    CHECK(glb.warnings.size() == 2); // glTF cannot hold 'count', a value of each face
    // A cloud has it whole.
    Mesh points;
    points.positions = {{0, 0, 0}, {1, 0, 0}};
    scene = test::scene_in_metres(points);
    scene.parts.push_back(scene.parts.front());
    scene.parts[1].mesh.attributes.push_back(
        {"quality", Domain::wedge, Role::generic, 1, false, std::vector<float>(2, 1)});
    CHECK(nans(test::run_stage("merge", "", scene).scene) == 2);
}

#include "support/catch.hpp"

#include "cache/state.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/render/render.hpp"
#include "io/codec.hpp"
#include "mesh/invariants.hpp"
#include "support/bench.hpp"
#include "support/failure.hpp"

#include <fmt/format.h>
#include <fstream>

namespace write_lines_test {

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// Three connected lines and a separate line, with colours.
Mesh wires() {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 4}, {3, 3, 3}, {4, 3, 3}};
    mesh.lines = {0, 1, 1, 2, 2, 3, 5, 4};
    mesh.attributes = {
        {"COLOR_0", Domain::wedge, Role::colour, 3, true,
         std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0, 0, 0, 0, 9, 9, 9}}};
    return mesh;
}

/// A cube and wires.
Scene cube_and_wires() {
    Scene scene = scene_of(shapes::cube(), Unit::m);
    scene.up = UpAxis::y;
    Part& part = scene.parts.emplace_back();
    part.name = "wires";
    part.mesh = wires();
    return scene;
}

Part only_wires() {
    Part part = cube_and_wires().parts[1];
    return part;
}

/// The ends of all lines of a scene, where they are.
std::vector<Vec3> ends_of(const Scene& scene) {
    std::vector<Vec3> ends;
    for (const Part& part : scene.parts)
        for (const Index w : part.mesh.lines)
            ends.push_back(part.transform.point(part.mesh.positions[part.mesh.vertex_of_wedge(w)]));
    return ends;
}

Value yaml(const std::string& text) {
    Problems none;
    return pipeline::parse_yaml(std::make_shared<const SourceText>(SourceText{"t", text}), none);
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

} // namespace

TEST_CASE("lines are written with their colours, alone and beside faces, and read again", "[stages]") {
    for (const char* given : {"a.ply", "{path: a.ply, ascii: true}", "{path: a.ply, big_endian: true}",
                              "a.obj", "a.glb", "a.gltf"})
        for (const bool faces : {false, true}) {
            INFO(given << faces);
            Bench b;
            b.scene = cube_and_wires();
            if (!faces) b.scene.parts.erase(b.scene.parts.begin());
            const auto ends = ends_of(b.scene);
            const Value options = yaml(given);
            b.run("write", options);
            CHECK(b.record.warnings.empty());
            CHECK(b.state.record.outputs.at(0).read_back["lines"] == 4);
            b.state.outputs.commit();
            b.scene = {};
            const std::string name = std::string(given).find("ply") != std::string::npos ? "a.ply" : given;
            b.run("load", Value::scalar(name));
            CHECK(b.record.warnings.empty());
            REQUIRE(b.scene.parts.size() == (faces ? 2 : 1));
            CHECK(broken_invariants(b.scene).empty());
            CHECK(ends_of(b.scene) == ends);
            const Mesh& mesh = b.scene.parts.back().mesh;
            CHECK(mesh.face_count() == 0);
            CHECK(mesh.vertex_count() == 6);
            const Attribute* colours = mesh.find("COLOR_0", Domain::wedge);
            REQUIRE(colours);
            CHECK(colours->value(mesh.lines[2], 1) == 1);
            CHECK(colours->value(mesh.lines[2], 0) == 0);
        }
}

TEST_CASE("lines that go on are one statement of an OBJ, under their material", "[stages]") {
    Bench b;
    b.scene = cube_and_wires();
    b.scene.materials = {{"steel", {1, 0, 0, 1}, false, -1, -1}, {"glass", {0, 0, 1, 1}, false, -1, -1}};
    b.scene.parts[0].mesh.primitives = {{1, {}, {}}};
    b.scene.parts[1].mesh.primitives = {{none, {}, {}}, {0, {}, {}}};
    b.scene.parts[1].mesh.line_primitive = {0, 1, 1, 1};
    b.run("write", Value::scalar("a.obj"));
    b.state.outputs.commit();
    const std::string text = text_of(b.dir / "a.obj");
    CHECK(text.ends_with("usemtl\nl 9 10\nusemtl steel\nl 10 11 12\nl 14 13\n"));
    CHECK(b.record.warnings.empty());
    b.run("write", Value::scalar("a.ply"));
    REQUIRE(b.record.warnings.size() == 2);
    for (const auto& warning : b.record.warnings) CHECK(warning.id == "W-MATERIAL");
    CHECK(b.record.warnings[0].message == "the colours of 1 material are not written to PLY: glass");
    CHECK(b.record.warnings[1].message == "points and lines have no material in PLY: wires");
}

TEST_CASE("formats that cannot hold lines say so, and refuse lines alone", "[stages]") {
    const std::string hint = "glb, gltf, obj, ply can store lines";
    for (const char* name : {"a.stl", "a.off", "a.3mf", "a.drc"}) {
        INFO(name);
        Bench b;
        b.scene = cube_and_wires();
        b.run("write", Value::scalar(name));
        REQUIRE(b.record.warnings.size() >= 1);
        CHECK(b.record.warnings[0].id == "W-LINES");
        CHECK(b.record.warnings[0].message.ends_with("cannot store lines, so 1 part is skipped: wires"));
        CHECK(b.record.warnings[0].hint == hint);
        CHECK(ends_of(b.scene) == ends_of(cube_and_wires()));
        b.scene.parts.erase(b.scene.parts.begin());
        CHECK(failure([&] { b.run("write", Value::scalar(std::string("b") + (name + 1))); }) ==
              fmt::format(
                  "stage [E-EMPTY] there is nothing to write to 'b{}': the scene has lines and no faces | {}",
                  name + 1, hint));
    }
    Bench b;
    b.scene.unit = Unit::m;
    b.scene.parts.push_back(only_wires());
    b.run("write", yaml("{path: a.glb, draco: true}"));
    REQUIRE(b.record.warnings.size() == 1);
    CHECK(b.record.warnings[0].id == "W-DRACO");
}

TEST_CASE("beside compressed faces lines stay, on their grid where there is one", "[stages]") {
    for (const char* given :
         {"{path: a.glb, draco: true}", "{path: a.glb, quantize: true}", "{path: a.glb, meshopt: true}",
          "{path: a.glb, meshopt: true, quantize: {position: 12}}", "{path: a.glb, interleave: true}",
          "{path: a.glb, normals: smooth}"}) {
        INFO(given);
        Bench b;
        b.scene = cube_and_wires();
        const auto ends = ends_of(b.scene);
        b.run("write", yaml(given));
        b.state.outputs.commit();
        b.scene = {};
        b.run("load", Value::scalar("a.glb"));
        const auto read = ends_of(b.scene);
        REQUIRE(read.size() == ends.size());
        for (std::size_t i = 0; i < ends.size(); ++i) CHECK(length(read[i] - ends[i]) < 2e-3);
    }
}

TEST_CASE("stages that work on faces leave lines as they are, and say so", "[stages]") {
    for (const auto& [stage, options, warns] : {std::tuple{"clip", "z=0.5", true},
                                                {"simplify", "50%", true},
                                                {"clean", "", false},
                                                {"merge", "", false},
                                                {"triangulate", "", false},
                                                {"optimize", "{}", false},
                                                {"split", "midpoint", true}}) {
        INFO(stage);
        Scene given = cube_and_wires();
        given.parts[0].transform.m[0][3] = given.parts[1].transform.m[0][3] = 0.5;
        const auto ends = ends_of(given);
        const auto run = run_stage(stage, options, given);
        CHECK(broken_invariants(run.scene).empty());
        CHECK(ends_of(run.scene) == ends);
        REQUIRE(run.scene.parts.size() == 2);
        CHECK(run.scene.parts.back().mesh.find("COLOR_0", Domain::wedge) != nullptr);
        const auto ids = run.warnings();
        CHECK((std::count(ids.begin(), ids.end(), "W-LINES") == 1) == warns);
        if (!warns) CHECK(run.record.said.at(0) == "1 part of lines skipped");
    }
    const auto moved = run_stage("transform", "{translate: [1, 0, 0], bake: true}", cube_and_wires());
    CHECK(ends_of(moved.scene).at(1) == Vec3{2, 0, 0});
    CHECK(moved.warnings().empty());
    const auto checked = run_stage("validate", "{lines: 4, isolated_vertices: 0}", cube_and_wires());
    for (const auto& check : checked.state->record.checks) CHECK(check.passed);
}

TEST_CASE("stages that work on faces leave points as they are, and say so", "[stages]") {
    Mesh points;
    points.positions = {{0, 0, 0}, {3, 0, 0}, {0, 3, 3}};
    for (const auto& [stage, options, warns] : {std::tuple{"relax", "3", true},
                                                {"split", "midpoint", true},
                                                {"thicken", "0.1", true},
                                                {"section", "z=50%", false},
                                                {"probe", "[0, 0, 1]", false}}) {
        INFO(stage);
        Scene given = scene_of(points);
        given.parts.push_back(scene_of(shapes::cube()).parts.front());
        given.parts.push_back(given.parts.front());
        given.parts.back().name = "other points";
        const auto run = run_stage(stage, options, given);
        CHECK(run.scene.parts.at(0).mesh.positions == points.positions);
        const auto ids = run.warnings();
        CHECK((std::count(ids.begin(), ids.end(), "W-POINTS") == 1) == warns);
        if (warns)
            CHECK(run.record.warnings.at(0).message ==
                  std::string(stage) + " works on faces and leaves 2 clouds of points unchanged");
        else
            CHECK(run.record.said.at(0) == "2 clouds of points skipped");
        const auto without = run_stage(stage, options, scene_of(shapes::cube())).warnings();
        CHECK(std::count(without.begin(), without.end(), "W-POINTS") == 0);
    }
    for (const char* options : {"{volume: {min: 1}}", "{isolated_vertices: 0}", "{min_angle: {min: 5}}"})
        CHECK(run_stage("validate", options, scene_of(points)).state->record.checks.at(0).hint ==
              "the scene has points but no faces, and most checks and stages need faces");
    CHECK(run_stage("validate", "{parts: 2}", scene_of(points)).state->record.checks.at(0).hint ==
          property_named("parts")->hint);
}

TEST_CASE("lines are in what the cache stores", "[stages]") {
    Scene scene = cube_and_wires();
    scene.parts[1].mesh.primitives.resize(2);
    scene.parts[1].mesh.line_primitive = {0, 1, 1, 0};
    const auto again = cache::decoded_scene(cache::encoded(scene));
    REQUIRE(again);
    CHECK(again->parts[1].mesh.lines == scene.parts[1].mesh.lines);
    CHECK(again->parts[1].mesh.line_primitive == scene.parts[1].mesh.line_primitive);
}

TEST_CASE("a picture shows lines from end to end, where they are within it", "[stages]") {
    Scene scene;
    Part& part = scene.parts.emplace_back();
    part.mesh.positions = {{0, 0, 0}, {4, 3, 0}};
    part.mesh.lines = {0, 1};
    PictureSettings settings;
    settings.width = settings.height = 100;
    settings.viewpoint = Viewpoint::front;
    settings.camera = {};
    const auto covered = [&] {
        const Picture picture = picture_of(scene, settings);
        std::vector<int> columns;
        for (int x = 0; x < picture.width; ++x)
            for (int y = 0; y < picture.height; ++y)
                if (picture.rgba[4 * static_cast<std::size_t>(y * picture.width + x) + 3] > 0) {
                    columns.push_back(x);
                    break;
                }
        return columns.size();
    };
    CHECK(covered() > 85);
    settings.zoom = 50; // its ends are far outside
    CHECK(covered() > 95);
    part.mesh.lines.clear();
    settings.zoom = 1;
    CHECK(covered() < 10);
}

TEST_CASE("lines of a document stay as written until they change, and keep material and extras", "[stages]") {
    const std::string text =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"wire","mesh":0,"extras":{"of":"node"}}],
 "materials":[{"name":"red"},{"name":"blue"}],
 "meshes":[{"primitives":[{"mode":3,"material":1,"extras":{"n":1},"attributes":{"POSITION":0}},
 {"mode":2,"material":0,"attributes":{"POSITION":0}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    Bench b;
    put(b.dir / "w.gltf", text);
    b.run("load", Value::scalar("w.gltf"));
    CHECK(b.record.warnings.empty());
    REQUIRE(b.scene.parts.size() == 1);
    CHECK(b.scene.parts[0].mesh.line_primitive == std::vector<Index>{0, 0, 1, 1, 1});
    const auto ends = ends_of(b.scene);
    b.run("transform", yaml("{translate: [0, 0, 1]}"));
    b.run("write", Value::scalar("moved.gltf"));
    b.run("transform", yaml("{translate: [0, 0, -1], bake: true}"));
    b.run("write", Value::scalar("changed.gltf"));
    CHECK(b.record.warnings.empty());
    b.state.outputs.commit();
    const Json moved = Json::parse(text_of(b.dir / "moved.gltf")),
               changed = Json::parse(text_of(b.dir / "changed.gltf"));
    CHECK(moved["meshes"][0]["primitives"][0]["mode"] == 3);
    CHECK(moved["nodes"][0]["extras"]["of"] == "node");
    const Json& primitives = changed["meshes"][0]["primitives"];
    REQUIRE(primitives.size() == 2);
    CHECK(primitives[0]["mode"] == 1);
    CHECK(primitives[0]["material"] == 1);
    CHECK(primitives[0]["extras"]["n"] == 1);
    CHECK(primitives[1]["material"] == 0);
    b.scene = {};
    b.run("load", Value::scalar("changed.gltf"));
    CHECK(ends_of(b.scene) == ends);
    b.run("load", Value::scalar("moved.gltf"));
    CHECK(ends_of(b.scene).at(10) == ends[0] + Vec3{0, 0, 1});
}

} // namespace write_lines_test

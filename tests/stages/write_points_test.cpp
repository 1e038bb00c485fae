#include "support/catch.hpp"

#include "base/json.hpp"
#include "io/codec.hpp"
#include "support/bench.hpp"
#include "support/colours.hpp"
#include "support/failure.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

namespace write_points_test {

using namespace facetmill;
using namespace facetmill::test;

TEST_CASE("point clouds are written with their colours, and read again", "[stages]") {
    for (const char* name : {"a.ply", "a.glb", "a.gltf", "a.obj", "a.off"}) {
        INFO(name);
        Bench b;
        put(b.dir / "p.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
            "z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n0 0 0 255 0 "
            "0\n1 0 0 0 255 0\n0 2 0 0 0 255\n");
        b.run("load", options({{"path", "p.ply"}, {"unit", "m"}, {"up", "y"}}));
        b.run("write", Value::scalar(name));
        CHECK(b.record.warnings.empty());
        b.state.outputs.commit();
        b.scene = {};
        b.run("load", Value::scalar(name));
        REQUIRE(b.scene.parts.size() == 1);
        const Mesh& mesh = b.scene.parts[0].mesh;
        CHECK(mesh.face_count() == 0);
        CHECK(mesh.positions == std::vector<Vec3>{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 2, 0}});
        const Attribute* colours = mesh.find("COLOR_0", Domain::wedge);
        REQUIRE(colours);
        CHECK(colours->value(1, 1) == 1);
        CHECK(colours->value(1, 0) == 0);
    }
}

namespace {

/// Points with a normal, a colour in bytes and a number each. Every tenth repeats the previous position.
Mesh cloud(std::size_t points) {
    Mesh mesh;
    std::vector<float> normals, numbers;
    std::vector<std::uint8_t> colours;
    std::uint32_t state = 7;
    const auto next = [&] { return (state = state * 1664525U + 1013904223U) >> 16; };
    for (std::size_t i = 0; i < points; ++i) {
        if (i % 10 == 9)
            mesh.positions.push_back(mesh.positions.back());
        else
            mesh.positions.push_back({next() / 65536.0, next() / 32768.0, next() / 1024.0});
        for (const float x : {0.0F, 0.6F, i % 2 == 0 ? 0.8F : -0.8F}) normals.push_back(x);
        for (int c = 0; c < 3; ++c) colours.push_back(static_cast<std::uint8_t>(next() % 256));
        numbers.push_back(static_cast<float>(i));
    }
    mesh.attributes = {{"NORMAL", Domain::wedge, Role::normal, 3, false, normals},
                       {"COLOR_0", Domain::wedge, Role::colour, 3, true, linear_words(colours, 3)},
                       {"_height", Domain::wedge, Role::generic, 1, false, numbers}};
    return mesh;
}

/// The points as written and read, by their number, which is whole in a file with enough bits.
std::map<std::size_t, std::size_t> by_number(const Mesh& mesh) {
    std::map<std::size_t, std::size_t> all;
    const Attribute* numbers = nullptr;
    for (const Attribute& a : mesh.attributes)
        if (a.components == 1) numbers = &a;
    REQUIRE(numbers);
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
        all[static_cast<std::size_t>(std::lround(numbers->value(i, 0)))] = i;
    return all;
}

} // namespace

TEST_CASE("Draco files hold point clouds, on a grid and in an order of their own", "[stages]") {
    const std::size_t points = GENERATE(1, 2, 17, 3000);
    Bench b;
    const Mesh given = cloud(points);
    b.scene.unit = Unit::m;
    b.scene.parts.emplace_back().mesh = given;
    Problems none;
    b.run("write",
          pipeline::parse_yaml(std::make_shared<const SourceText>(SourceText{
                                   "t", "{path: a.drc, draco: {position_bits: 16, generic_bits: 16}}"}),
                               none));
    b.state.outputs.commit();
    if (points == 3000) CHECK(std::filesystem::file_size(b.dir / "a.drc") < points * 14); // of 31 bytes
    b.scene = {};
    b.run("load", Value::scalar("a.drc"));
    REQUIRE(b.scene.parts.size() == 1);
    const Mesh& mesh = b.scene.parts[0].mesh;
    CHECK(mesh.face_count() == 0);
    REQUIRE(mesh.vertex_count() == points);
    const Attribute *normals = mesh.find("NORMAL", Domain::wedge),
                    *colours = mesh.find("COLOR_0", Domain::wedge);
    REQUIRE(normals);
    REQUIRE(colours);
    const double step = 64.0 / 65535;
    for (const auto& [number, i] : by_number(mesh)) {
        REQUIRE(number < points);
        CHECK(length(mesh.positions[i] - given.positions[number]) <= step);
        for (std::size_t c = 0; c < 3; ++c) {
            CHECK(normals->value(i, c) == Approx(given.attributes[0].value(number, c)).margin(1e-2));
            CHECK(colours->value(i, c) == given.attributes[1].value(number, c));
        }
    }
    CHECK(by_number(mesh).size() == points);
}

TEST_CASE("Draco's points are refused where their tree and their header disagree", "[stages]") {
    Bench b;
    b.scene.unit = Unit::m;
    b.scene.parts.emplace_back().mesh = cloud(17);
    b.run("write", Value::scalar("a.drc"));
    b.state.outputs.commit();
    std::ifstream stream(b.dir / "a.drc", std::ios::binary);
    const std::string good{std::istreambuf_iterator<char>(stream), {}};
    const auto read = [](std::string bytes) {
        return failure([&] {
            io::ReadLog log;
            const auto span = std::as_bytes(std::span(bytes));
            io::read_scene(io::Input::of("a.drc", {span.begin(), span.end()}), {}, log);
        });
    };
    const std::string count("\x11\0\0\0", 4);
    const auto in_header = good.find(count), in_tree = good.find(count, in_header + 1);
    REQUIRE(in_tree != std::string::npos);
    for (const auto at : {in_header, in_tree}) {
        std::string bad = good;
        bad[at + 1] = 1;
        CHECK(read(bad).find("points, but its header") != std::string::npos);
    }
    for (std::size_t at = 5; at < good.size(); ++at) // whatever is wrong: an error, or other points
        for (const char value : {'\0', '\x7f', '\xff'}) {
            std::string bad = good;
            bad[at] = value;
            const std::string said = read(bad);
            CHECK((said == "nothing" || said.find("[E-") != std::string::npos));
        }
}

TEST_CASE("formats of faces only refuse point clouds, and scenes without anything are refused", "[stages]") {
    const auto refusal = [](const Value& given) {
        Bench b;
        b.scene.unit = Unit::mm;
        b.scene.parts.emplace_back().mesh.positions = {{0, 0, 0}, {1, 0, 0}};
        return failure([&] { b.run("write", given); });
    };
    const std::string hint = " | drc, glb, gltf, obj, off, ply can store points";
    for (const char* name : {"a.stl", "a.3mf"})
        CHECK(refusal(Value::scalar(name)) ==
              fmt::format(
                  "stage [E-EMPTY] there is nothing to write to '{}': the scene has points and no faces{}",
                  name, hint));
    Bench empty;
    CHECK(failure([&] { empty.run("write", Value::scalar("a.ply")); }) ==
          "stage [E-EMPTY] there is nothing to write to 'a.ply': the scene has neither faces nor points | "
          "check the result of the stages before; the common key when: {vertices: {min: 1}} skips an empty "
          "write");
}

/// Four points and a triangle, as parts.
Scene points_and_triangle() {
    Scene scene;
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    Part& points = scene.parts.emplace_back();
    points.name = "points";
    points.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
    Part& triangle = scene.parts.emplace_back();
    triangle.name = "triangle";
    triangle.mesh.positions = {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    triangle.mesh.corners = {0, 1, 2};
    return scene;
}

TEST_CASE("formats keep points beside faces, or warn that they leave them out", "[stages]") {
    for (const char* name : {"a.glb", "a.gltf", "a.ply", "a.obj", "a.off"}) {
        INFO(name);
        Bench b;
        b.scene = points_and_triangle();
        b.run("write", Value::scalar(name));
        for (const auto& warning : b.record.warnings) CHECK(warning.id == "W-PARTS");
        b.state.outputs.commit();
        b.scene = {};
        b.run("load", Value::scalar(name));
        std::size_t vertices = 0;
        for (const Part& part : b.scene.parts) vertices += part.mesh.vertex_count();
        CHECK(vertices == 7);
        CHECK(b.scene.face_count() == 1);
    }
    for (const char* name : {"a.stl", "a.drc", "a.3mf"}) {
        INFO(name);
        Bench b;
        b.scene = points_and_triangle();
        b.run("write", Value::scalar(name));
        REQUIRE(b.record.warnings.size() == 1);
        CHECK(b.record.warnings[0].id == "W-SKIPPED");
        CHECK(b.record.warnings[0].message.ends_with(
            "cannot store points next to faces, so 1 part is skipped: points"));
        CHECK(b.scene.parts[0].mesh.vertex_count() == 4);
    }
}

TEST_CASE("a GLB of points is compressed within half a step of its grid", "[stages]") {
    for (const auto& given : {options({{"path", "a.glb"}, {"meshopt", "true"}}),
                              options({{"path", "a.glb"}, {"quantize", "true"}}),
                              options({{"path", "a.glb"}, {"quantize", "true"}, {"meshopt", "true"}}),
                              options({{"path", "a.glb"}, {"draco", "true"}})}) {
        Bench b;
        b.scene.unit = Unit::m;
        b.scene.up = UpAxis::y;
        const Mesh points = cloud(3000);
        b.scene.parts.emplace_back().mesh = points;
        b.run("write", given);
        b.state.outputs.commit();
        b.scene = {};
        b.run("load", Value::scalar("a.glb"));
        REQUIRE(b.scene.parts.size() == 1);
        const Part& part = b.scene.parts[0];
        REQUIRE(part.mesh.vertex_count() == 3000);
        const double step = 64.0 / ((1 << 14) - 1);
        for (const auto& [number, i] : by_number(part.mesh))
            CHECK(length(part.transform.point(part.mesh.positions[i]) - points.positions[number]) <= step);
    }
}

TEST_CASE("clean and optimize keep the distinct points of a cloud", "[stages]") {
    Bench b;
    b.scene = points_and_triangle();
    Mesh& points = b.scene.parts[0].mesh;
    points.positions.push_back(points.positions[0]);
    points.attributes.push_back(
        {"COLOR_0", Domain::wedge, Role::colour, 3, true, std::vector<std::uint8_t>(15, 200)});
    b.run("clean", Value::map({}));
    b.run("optimize", Value::map({}));
    REQUIRE(b.scene.parts.size() == 2);
    CHECK(b.scene.parts[0].mesh.vertex_count() == 4);
    CHECK(b.scene.parts[0].mesh.wedge_count() == 4);
}

TEST_CASE("a GLB of points keeps its nodes, its shared mesh and its animation", "[stages]") {
    const std::string text =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"name":"survey","nodes":[0]}],
 "nodes":[{"name":"site","extras":{"station":7},"children":[1,2],"scale":[2,2,2]},{"name":"a","mesh":0},
 {"name":"b","mesh":0,"translation":[9,0,0]}],
 "cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],
 "animations":[{"samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}],
 "meshes":[{"name":"scan","extras":{"scanner":"x"},"primitives":[{"attributes":{"POSITION":0},"mode":0}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
 {"bufferView":1,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[2]},
 {"bufferView":2,"componentType":5126,"count":3,"type":"VEC3"}],
 "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":48,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAABA"}]})";
    for (const bool changed : {false, true})
        for (const auto& given : {options({{"path", "b.gltf"}}),
                                  options({{"path", "b.gltf"}, {"meshopt", "true"}, {"quantize", "true"}})}) {
            Bench b;
            put(b.dir / "a.gltf", text);
            b.run("load", Value::scalar("a.gltf"));
            CHECK(b.record.warnings.empty());
            REQUIRE(b.scene.parts.size() == 2);
            for (Part& part : b.scene.parts) part.changed = changed;
            b.run("write", given);
            CHECK(b.record.warnings.empty());
            b.state.outputs.commit();
            const Json json = Json::parse(std::ifstream(b.dir / "b.gltf"));
            CHECK(json["scenes"][0]["name"] == "survey");
            CHECK(json["meshes"].size() == 1);
            CHECK(json["meshes"][0]["extras"]["scanner"] == "x");
            CHECK(json["nodes"][0]["extras"]["station"] == 7);
            CHECK(json["nodes"][0]["children"] == Json{1, 2});
            CHECK(json["cameras"].size() == 1);
            CHECK(json["animations"].size() == 1);
        }
}

} // namespace write_points_test

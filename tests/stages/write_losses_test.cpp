// Losses that can stop a run: each is a warning with its own id.
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"
#include "support/run_stage.hpp"
#include "support/temporary.hpp"

#include <fmt/format.h>
#include <set>

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// The stage writes, and its warnings are given, "ID message (hint)" a line.
std::string warnings_of(const Scene& scene, const std::string& options) {
    const StageRun run = run_stage("write", options, scene);
    std::string all;
    for (const auto& w : run.record.warnings) all += fmt::format("{} {} ({})\n", w.id, w.message, w.hint);
    return all;
}

Scene far_away(double offset) {
    Scene scene = test::scene_in_metres(shapes::icosphere(2), "ball");
    for (Vec3& p : scene.parts[0].mesh.positions) p = p * 10 + Vec3{offset, offset / 10, 0.123456789};
    return scene;
}

} // namespace

TEST_CASE("coordinates that 32-bit floats are too coarse for are said", "[stages]") {
    const TemporaryDirectory dir;
    const std::string glb = (dir / "a.glb").string(), ply = (dir / "a.ply").string();
    const Scene scene = far_away(5.4e6); // a northing of UTM
    const std::string plain = warnings_of(scene, fmt::format("{{path: {}, origin: keep}}", glb));
    CHECK(plain.find("W-ROUNDED") == 0);
    CHECK(plain.find("so far from the origin") != std::string::npos);
    CHECK(plain.find("write glTF with origin: auto") != std::string::npos);
    const std::string draco = warnings_of(scene, fmt::format("{{path: {}, draco: true, origin: keep}}", glb));
    CHECK(draco.find("so far from the origin") != std::string::npos);
    // Its grid is in the node, in 64 bits.
    CHECK(warnings_of(scene, fmt::format("{{path: {}, quantize: true}}", glb)).empty());
    CHECK(draco.find("draco.position_bits") == std::string::npos);
    CHECK(warnings_of(scene, fmt::format("{{path: {}, precision: single}}", ply))
              .find("precision: full keeps all digits") != std::string::npos);
    CHECK(warnings_of(scene, fmt::format("{{path: {}, precision: full}}", ply)).empty());
    for (const char* name : {"b.ply", "b.obj", "b.off"}) { // which have all digits where they need them
        INFO(name);
        const auto run = run_stage("write", (dir / name).string(), scene);
        CHECK(run.record.warnings.empty());
        REQUIRE(run.record.said.size() == 1);
        CHECK(run.record.said[0].find(
                  "positions are written with 64 bits, because float32 would move them by up to 0.2") == 0);
        CHECK(run.state->record.outputs.at(0).read_back["position_error"].get<double>() < 1e-9);
        CHECK(run_stage("write", (dir / ("near_" + std::string(name))).string(), far_away(0))
                  .record.said.empty());
    }
    Scene rounded = scene; // float32 moves no point of it
    for (Vec3& p : rounded.parts[0].mesh.positions)
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = static_cast<double>(static_cast<float>(p[axis]));
    CHECK(run_stage("write", (dir / "c.ply").string(), rounded).record.said.empty());
    for (const char* options : {"{{path: {}}}", "{{path: {}, draco: true}}"})
        for (const Scene& one : {far_away(0), scene}) // the scene that gets its own origin
            CHECK(warnings_of(one, fmt::format(fmt::runtime(options), glb)).empty());
}

TEST_CASE("animations and skins that a format does not get are said", "[stages]") {
    const TemporaryDirectory dir;
    io::ReadLog log;
    const Scene scene = test::read_text(
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"name":"bone"}],
 "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
 "animations":[{"samplers":[{"input":1,"output":0}],"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
 {"bufferView":0,"byteOffset":12,"componentType":5126,"count":3,"type":"SCALAR","min":[0],"max":[1]}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})",
        &log);
    for (const char* name : {"b.stl", "b.obj", "b.ply", "b.off", "b.3mf"}) {
        INFO(name);
        CHECK(warnings_of(scene, (dir / name).string()).find("W-ANIMATION 1 animation is not written to ") !=
              std::string::npos);
    }
    CHECK(warnings_of(scene, (dir / "b.glb").string()).find("W-ANIMATION") == std::string::npos);
}

TEST_CASE("textures that a format does not get are said", "[stages]") {
    const TemporaryDirectory dir;
    put(dir / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    put(dir / "a.mtl", "newmtl m\nmap_Kd a.png\n");
    put(dir / "a.png", red_png());
    io::ReadLog log;
    const Scene scene = io::read_scene(io::Input::open(dir / "a.obj"), {}, log);
    CHECK(log.warnings.empty());
    CHECK(
        warnings_of(scene, (dir / "b.ply").string()).find("W-TEXTURES the textures of 1 material are not") ==
        0);
    for (const char* name : {"b.glb", "b.obj"})
        CHECK(warnings_of(scene, (dir / name).string()).find("W-TEXTURES") == std::string::npos);
    put(dir / "a.mtl", "newmtl m\nKd 1 0 0\n");
    const Scene plain = io::read_scene(io::Input::open(dir / "a.obj"), {}, log);
    CHECK(warnings_of(plain, (dir / "b.obj").string()).empty());
}

TEST_CASE("what a format of colours has no words for in a material is said", "[stages]") {
    const TemporaryDirectory dir;
    const auto warned = [&](const std::string& material, const char* name) {
        put(dir / "a.gltf",
            R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
 "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"materials":[)" +
                material + R"(],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
        io::ReadLog log;
        return warnings_of(io::read_scene(io::Input::open(dir / "a.gltf"), {}, log), (dir / name).string());
    };
    const std::string lamp = R"({"name":"lamp","emissiveFactor":[0,0.5,0],
 "pbrMetallicRoughness":{"metallicFactor":0.5,"roughnessFactor":0.2}})";
    CHECK(warned(lamp, "b.3mf") ==
          "W-MATERIAL the metalness, roughness, emission of 1 material are not written to 3MF, which has "
          "colours only: lamp (glTF and OBJ keep them)\n");
    CHECK(warned(R"({"emissiveFactor":[0,0,1],"pbrMetallicRoughness":{"metallicFactor":0}})", "b.3mf") ==
          "W-MATERIAL the emission of 1 material is not written to 3MF, which has colours only: 0 (glTF and "
          "OBJ keep them)\n");
    CHECK(
        warned(R"({"emissiveFactor":[0,0,0],"pbrMetallicRoughness":{"metallicFactor":0}})", "b.3mf").empty());
    CHECK(warned(lamp, "b.glb").empty());
    CHECK(warned(lamp, "b.obj").empty());
}

TEST_CASE("instances that stages do not see are said, and points without faces", "[stages]") {
    const char* const start = R"({"asset":{"version":"2.0"},"extensionsUsed":["EXT_mesh_gpu_instancing"],
 "scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"tree","mesh":0,"extensions":{"EXT_mesh_gpu_instancing":
 {"attributes":{"TRANSLATION":0}}}}],"meshes":[{"primitives":[{"attributes":{"POSITION":0})";
    const char* const end = R"(}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    io::ReadLog log;
    const Scene scene = test::read_text(std::string(start) + end, &log);
    REQUIRE(log.warnings.size() == 1);
    CHECK(log.warnings[0].id == "W-INSTANCING");
    CHECK(log.warnings[0].message.find("part 'tree' has 3 instances") == 0);
    CHECK(Json::parse(json_of(written(scene, "glb").files[0].bytes))["nodes"][0].contains("extensions"));
    io::ReadSettings expand;
    expand.expand_instances = true;
    log = {};
    const Scene each = io::codec_named("gltf")->read(
        io::Input::of("t", test::to_bytes(std::string(start) + end)), expand, log);
    CHECK(log.warnings.empty());
    REQUIRE(each.parts.size() == 3);
    CHECK(each.parts[1].transform.point({0, 0, 0}) == Vec3{1, 0, 0}); // the instances are at the corners
    CHECK(each.parts[0].name == "tree");
    const Scene points = test::read_text(std::string(start) + R"(,"mode":0)" + end);
    REQUIRE(points.parts.size() == 1);
    CHECK(points.parts[0].mesh.vertex_count() == 3);
    CHECK(points.face_count() == 0);
}

TEST_CASE("parts that become one mesh, and names that a format does not get, are said", "[stages]") {
    const TemporaryDirectory dir;
    Scene two = test::scene_in_metres(shapes::cube(), "left");
    const std::string one_part = warnings_of(two, (dir / "one.ply").string());
    CHECK(one_part.empty()); // who converts a single part sees nothing
    two.parts.push_back({.name = "right", .mesh = shapes::cube()});
    two.parts[1].transform.m[0][3] = 5;
    for (const auto& [name, format] :
         {std::pair{"b.ply", "PLY"}, std::pair{"b.off", "OFF"}, std::pair{"b.stl", "STL"}}) {
        INFO(name);
        CHECK(warnings_of(two, (dir / name).string()) ==
              fmt::format(
                  "W-PARTS 2 parts become one mesh in {}, without their names: left, right (glTF, OBJ and "
                  "3MF keep them: write .glb)\n",
                  format));
    }
    for (const char* options : {"{}/b.obj", "{}/b.3mf", "{}/b.glb", "{{path: {}/c.stl, ascii: true}}"})
        CHECK(warnings_of(two, fmt::format(fmt::runtime(options), dir.path().string())).empty());
    two.parts[0].name = "left\nhand";
    for (const char* options : {"{}/b.obj", "{}/b.3mf", "{{path: {}/c.stl, ascii: true}}"}) {
        INFO(options);
        CHECK(warnings_of(two, fmt::format(fmt::runtime(options), dir.path().string()))
                  .find("W-NAME a name has control characters, which are not written to ") == 0);
    }
    CHECK(warnings_of(two, (dir / "b.glb").string()).empty());
}

TEST_CASE("attributes that 3MF has no place for are said", "[stages]") {
    const TemporaryDirectory dir;
    Scene scene = test::scene_in_metres(shapes::cube());
    Mesh& mesh = scene.parts[0].mesh;
    mesh.attributes.push_back({"NORMAL", Domain::vertex, Role::normal, 3, false,
                               std::vector<float>(3 * mesh.vertex_count(), 0.5F)});
    CHECK(warnings_of(scene, (dir / "a.3mf").string()).empty()); // they follow from the faces
    mesh.attributes.push_back(
        {"_heat", Domain::vertex, Role::generic, 1, false, std::vector<float>(mesh.vertex_count(), 1.0F)});
    CHECK(warnings_of(scene, (dir / "a.3mf").string()) ==
          "W-ATTRIBUTE 3MF cannot store attributes: _heat (glTF keeps them: write .glb)\n");
}

TEST_CASE("a backslash in the name of a file is none in the names beside it", "[stages]") {
    const TemporaryDirectory dir;
    const Scene scene = test::scene_in_metres(shapes::cube());
    const std::string path = (dir / "back\\slash.gltf").string();
    CHECK(warnings_of(scene, "{path: '" + path + "'}").empty()); // read back, with its buffer
}

TEST_CASE("colours of faces are kept where corners have colours, and said elsewhere", "[stages]") {
    const TemporaryDirectory dir;
    // A tetrahedron whose faces are red, green, blue and yellow.
    const std::string off = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 255 0 0\n3 0 1 3 0 255 0\n"
                            "3 1 2 3 0 0 255\n3 0 3 2 255 255 0\n";
    io::ReadLog log;
    Scene scene = io::read_scene(io::Input::of("a.off", to_bytes(off)), {}, log);
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    for (const char* format : {"glb", "3mf", "drc", "ply", "off", "stl"}) {
        INFO(format);
        const io::Written file = written(scene, format);
        CHECK(file.warnings.empty());
        const Scene back = read_bytes(file.files.at(0).bytes, format);
        const Mesh& mesh = back.parts.at(0).mesh;
        const Attribute* of_faces = mesh.find("COLOR_0", Domain::face);
        const Attribute* colours = of_faces ? of_faces : mesh.find("COLOR_0", Domain::wedge);
        REQUIRE(colours);
        std::multiset<std::vector<double>> found;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const auto wedges = mesh.face_wedges(f);
            std::vector<double> colour;
            for (int c = 0; c < 3; ++c) colour.push_back(colours->value(of_faces ? f : wedges[0], c));
            for (const Index w : wedges)
                for (int c = 0; c < 3; ++c)
                    CHECK(colours->value(of_faces ? f : w, c) == colour[static_cast<std::size_t>(c)]);
            found.insert(colour);
        }
        CHECK(found == std::multiset<std::vector<double>>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}});
    }
    CHECK(warnings_of(scene, (dir / "b.obj").string()) ==
          "W-ATTRIBUTE OBJ cannot store attributes: COLOR_0 (glTF keeps them: write .glb)\n");
    scene.parts[0].mesh.attributes.push_back(
        {"quality", Domain::face, Role::generic, 1, false, std::vector<float>(4, 1.0F)});
    CHECK(warnings_of(scene, (dir / "b.glb").string()) ==
          "W-ATTRIBUTE glTF cannot store attributes: quality of faces (PLY keeps them: write .ply)\n");
}

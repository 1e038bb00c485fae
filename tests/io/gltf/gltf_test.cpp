#include "io/codec.hpp"
#include "io/gltf/draco/quantise.hpp"
#include "mesh/shapes.hpp"
#include "parallel/allocation_cap.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"
#include "support/gltf.hpp"

using namespace facetmill;
using test::drawn;

namespace {

Mesh two_materials() {
    Mesh mesh = shapes::uv_cube();
    mesh.primitives = {{0, {}, ""}, {1, {}, ""}};
    std::vector<std::uint32_t> of_face(mesh.face_count());
    for (std::size_t f = 0; f < of_face.size(); ++f) of_face[f] = f % 2;
    mesh.attributes.push_back(
        {std::string(primitive_attribute), Domain::face, Role::index, 1, false, of_face});
    return mesh;
}

Scene scene_of_two_materials() {
    Scene scene = test::scene_in_metres(two_materials());
    scene.materials = {{"red", {1, 0, 0, 1}, false, -1, -1}, {"blue", {0, 0, 1, 1}, true, -1, -1}};
    return scene;
}

const Mesh& only_mesh(const Scene& scene) {
    REQUIRE(scene.parts.size() == 1);
    CHECK(broken_invariants(scene).empty());
    return scene.parts[0].mesh;
}

} // namespace

TEST_CASE("shapes are the same after writing and reading a GLB", "[io]") {
    for (const Mesh& mesh :
         {shapes::tetrahedron(), shapes::cube(), shapes::uv_cube(), shapes::icosphere(2), shapes::torus(9, 7),
          shapes::grid(3, 4), shapes::bowtie(), shapes::fan3(), shapes::crossing()}) {
        const Scene read = test::again(test::scene_in_metres(mesh));
        CHECK(drawn(only_mesh(read)) == drawn(mesh));
        CHECK(read.parts[0].mesh.vertex_count() == mesh.vertex_count());
        CHECK(read.parts[0].mesh.wedge_count() == mesh.wedge_count());
    }
}

TEST_CASE("a written glTF is in metres with y up", "[io]") {
    const Scene read = test::again(test::scene_in_metres(shapes::cube()));
    CHECK(read.unit == Unit::m);
    CHECK(read.up == UpAxis::y);
}

TEST_CASE("polygons are written as triangles", "[io]") {
    CHECK(only_mesh(test::again(test::scene_in_metres(shapes::quad_cube()))).face_count() == 12);
}

TEST_CASE("a part without faces is a node without mesh", "[io]") {
    const Json json =
        Json::parse(test::json_of(test::written(test::scene_in_metres(Mesh{}), "glb").files[0].bytes));
    CHECK(json["nodes"] == Json::parse(R"([{"name":"thing"}])"));
    CHECK_FALSE(json.contains("meshes"));
}

TEST_CASE("primitives come apart by material and together again", "[io]") {
    const Scene scene = scene_of_two_materials();
    const io::Written written = test::written(scene, "glb");
    const Json json = Json::parse(test::json_of(written.files[0].bytes));
    CHECK(json["meshes"][0]["primitives"].size() == 2);
    const Scene read = test::read_bytes(written.files[0].bytes, "glb");
    CHECK(drawn(only_mesh(read)) == drawn(scene.parts[0].mesh));
    CHECK(read.materials.at(1).name == "blue");
    CHECK(read.materials.at(1).double_sided);
    CHECK(read.parts[0].mesh.wedge_count() == scene.parts[0].mesh.wedge_count());
}

TEST_CASE("node transforms and names survive", "[io]") {
    Scene scene = test::scene_in_metres(shapes::cube(), "first");
    scene.parts.push_back(scene.parts[0]);
    scene.parts[1].name = "second";
    scene.parts[1].transform.m[0][3] = 5;
    scene.parts[1].transform.m[1][1] = 2;
    const Scene read = test::again(scene);
    REQUIRE(read.parts.size() == 2);
    CHECK(read.parts[0].transform.identity());
    CHECK(read.parts[1].transform == scene.parts[1].transform);
    CHECK(read.parts[1].name == "second");
}

TEST_CASE("Draco keeps faces, closedness and seams", "[io]") {
    io::WriteSettings settings;
    settings.draco.on = true;
    for (const Mesh& mesh : {shapes::uv_cube(), shapes::icosphere(3), shapes::torus(12, 8)}) {
        const Scene read = test::again(test::scene_in_metres(mesh), settings);
        CHECK(only_mesh(read).face_count() == mesh.face_count());
        CHECK(read.parts[0].mesh.vertex_count() == mesh.vertex_count());
        CHECK(read.parts[0].mesh.wedge_count() == mesh.wedge_count());
        CHECK(length(read.parts[0].mesh.bounds().max - mesh.bounds().max) <
              2.0 / 16383); // one step of 14 bits
    }
}

TEST_CASE("Draco primitives of one mesh meet without cracks", "[io]") {
    io::WriteSettings settings;
    settings.draco.on = true;
    settings.draco.position_bits = 6;
    Scene scene = scene_of_two_materials();
    for (auto& p : scene.parts[0].mesh.positions) p = p * 0.7 + Vec3{0.1, 0.2, 0.3};
    CHECK(only_mesh(test::again(scene, settings)).vertex_count() == 8);
}

TEST_CASE("one degenerate face costs Draco nothing", "[io]") {
    const Scene plain = test::scene_in_metres(shapes::icosphere(4));
    Scene scene = plain;
    scene.parts[0].mesh.corners.insert(scene.parts[0].mesh.corners.end(), {0, 0, 1});
    io::WriteSettings settings;
    settings.draco.on = true;
    for (const char* codec : {"glb", "drc"}) {
        INFO(codec);
        const std::size_t before = test::written(plain, codec, settings).files[0].bytes.size();
        const io::Written dropped = test::written(scene, codec, settings);
        CHECK(dropped.files[0].bytes.size() == before);
        CHECK(dropped.dropped_faces == 1);
        REQUIRE(dropped.warnings.size() == 1);
        CHECK(dropped.warnings[0].id == "W-FACES");
    }
    settings.draco.keep_degenerate = true;
    const io::Written kept = test::written(scene, "glb", settings);
    CHECK(kept.warnings.empty());
    CHECK(kept.dropped_faces == 0);
    CHECK(kept.files[0].bytes.size() < test::written(plain, "glb", settings).files[0].bytes.size() + 1000);
    CHECK(only_mesh(test::read_bytes(kept.files[0].bytes, "glb")).face_count() ==
          scene.parts[0].mesh.face_count());
}

TEST_CASE("a mesh of degenerate faces keeps them under Draco", "[io]") {
    Mesh mesh = shapes::tetrahedron();
    for (std::size_t f = 0; f < 4; ++f) mesh.corners[3 * f + 1] = mesh.corners[3 * f];
    io::WriteSettings settings;
    settings.draco.on = true;
    CHECK(only_mesh(test::again(test::scene_in_metres(mesh), settings)).face_count() == 4);
}

TEST_CASE("plain Draco files are written and read", "[io]") {
    const Mesh mesh = shapes::uv_cube();
    const io::Written written = test::written(test::scene_in_metres(mesh), "drc");
    const Scene read = test::read_bytes(written.files[0].bytes, "drc");
    CHECK(only_mesh(read).face_count() == 12);
    CHECK(read.parts[0].mesh.vertex_count() == 8);
    CHECK(read.parts[0].mesh.find("TEXCOORD_0", Domain::wedge));
}

TEST_CASE("EXT_mesh_manifold gives the same vertices back, and says when a mesh is none", "[io]") {
    io::WriteSettings settings;
    settings.mesh_manifold = true;
    // Two tetrahedra at the same corner point: separate by the extension, merged by position.
    Mesh mesh = shapes::tetrahedron();
    append(mesh, shapes::tetrahedron());
    for (std::size_t v = 4; v < 8; ++v)
        mesh.positions[v] = mesh.positions[0] + (mesh.positions[0] - mesh.positions[v]);
    for (std::size_t c = 12; c < 24; c += 3) std::swap(mesh.corners[c], mesh.corners[c + 1]);
    CHECK(only_mesh(test::again(test::scene_in_metres(mesh), settings)).vertex_count() == 8);
    CHECK(only_mesh(test::again(test::scene_in_metres(mesh))).vertex_count() == 7);
    const io::Written open = test::written(test::scene_in_metres(shapes::grid(1, 1)), "glb", settings);
    REQUIRE(open.warnings.size() == 1);
    CHECK(open.warnings[0].message ==
          "part 'thing' is not a closed manifold, so EXT_mesh_manifold is not written");
}

TEST_CASE("attributes of types that glTF lacks are converted, face attributes dropped, and both said",
          "[io]") {
    Mesh mesh = shapes::tetrahedron();
    mesh.attributes.push_back(
        {"quality", Domain::vertex, Role::generic, 1, false, std::vector<double>{0.5, 1, 2, 3}});
    mesh.attributes.push_back(
        {"cell", Domain::face, Role::generic, 1, false, std::vector<float>{1, 2, 3, 4}});
    io::WriteSettings settings;
    settings.order = io::TriangleOrder::keep;
    const io::Written written = test::written(test::scene_in_metres(mesh), "glb", settings);
    CHECK(written.changes ==
          AttributeChanges{
              {"quality", Domain::vertex, AttributeChange::Kind::kept,
               "written as float32, because glTF does not allow float64 for it"},
              {"cell", Domain::face, AttributeChange::Kind::dropped, "glTF has no face attributes"}});
    const Scene read = test::read_bytes(written.files[0].bytes, "glb");
    const Attribute* quality = read.parts[0].mesh.find("_quality", Domain::wedge);
    REQUIRE(quality);
    CHECK(quality->value(2, 0) == 2);
}

TEST_CASE("a .gltf names its .bin after the title", "[io]") {
    io::WriteSettings settings;
    settings.title = "my part";
    const io::Written written = test::written(test::scene_in_metres(shapes::cube()), "gltf", settings);
    REQUIRE(written.files.size() == 2);
    CHECK(written.files[0].name == "my part.gltf");
    CHECK(written.files[1].name == "my part.bin");
    const auto& text = written.files[0].bytes;
    CHECK(Json::parse(reinterpret_cast<const char*>(text.data()),
                      reinterpret_cast<const char*>(text.data()) + text.size())["buffers"][0]["uri"] ==
          "my%20part.bin");
}

TEST_CASE("glTF that must not be read is refused with the place", "[io]") {
    const auto refuse = [](std::string_view text) { return test::failure([&] { test::read_text(text); }); };
    const std::string head = R"({"asset":{"version":"2.0"},)";
    CHECK(refuse("{") == "malformed [E-JSON] test: not valid JSON at byte 2");
    CHECK(refuse(R"({"asset":{"version":"1.0"}})") == "malformed [E-VERSION] test: asset.version: expected "
                                                      "glTF 2.x, found \"1.0\" | convert it to glTF 2.0: "
                                                      "npx gltf-pipeline -i old.gltf -o new.gltf");
    CHECK(refuse(R"({"asset":{"version":"3.0"}})") ==
          "malformed [E-VERSION] test: asset.version: expected glTF 2.x, found \"3.0\"");
    CHECK(refuse(R"({"meshes":{"a":{"primitives":[]}}})") ==
          "malformed [E-VERSION] test: expected glTF 2.x, found glTF 1.0 | convert it to glTF 2.0: npx "
          "gltf-pipeline -i old.gltf -o new.gltf");
    CHECK(refuse(std::string_view("glTF\1\0\0\0\x18\0\0\0\4\0\0\0\0\0\0\0{}  ", 24)) ==
          "malformed [E-VERSION] test: at byte 4: expected GLB version 2, found version 1 | convert it to "
          "glTF 2.0: npx gltf-pipeline -i old.gltf -o new.gltf");
    CHECK(refuse(head + R"("extensionsRequired":["XX_other"]})") ==
          "malformed [E-EXTENSION] test: extensionsRequired[0]: the extension \"XX_other\" is required but "
          "not supported");
    CHECK(refuse(head + R"("nodes":[{"children":[1]},{"children":[0]}]})") ==
          "malformed [E-NODES] test: nodes[0]: the node is its own ancestor");
    CHECK(refuse(head + R"("meshes":[{"primitives":[{"attributes":{"POSITION":7}}]}]})") ==
          "malformed [E-GLTF] test: meshes[0].primitives[0].attributes.POSITION: refers to accessor 7, but "
          "there are 0");
    const std::string
        inside = "only relative URIs to files in the glTF's folder or below are read",
        below = "--asset-root .., or load: {path: ..., asset_root: ..}, allows the files below that "
                "folder";
    for (const auto& [uri, hint] : {std::pair("/etc/passwd", inside),
                                    {"http://a.b/c.bin", inside},
                                    {"file:///a.bin", inside},
                                    {"../a.bin", below},
                                    {"%2e%2e/a.bin", below},
                                    {"a/../../b.bin", below}})
        CHECK(refuse(head + R"("buffers":[{"byteLength":4,"uri":")" + uri + R"("}]})") ==
              std::string("malformed [E-URI] test: buffers[0].uri: \"") + uri +
                  "\" is not a file in the document's directory | " + hint);
    CHECK(refuse(std::string(100000, '[')) ==
          "malformed [E-JSON] test: the JSON is nested deeper than 256 levels at byte 256");
}

TEST_CASE("counts are not believed", "[io]") {
    CHECK(
        test::failure([] {
            test::read_text(
                R"({"asset":{"version":"2.0"},"accessors":[{"componentType":5126,"type":"VEC3","count":1000000000}],
                                "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
        }) ==
        "limit [E-LIMIT] test: accessors[0]: 1000000000 elements without bytes in the file are too many");
}

TEST_CASE("Draco decodes what takes far less room than it decodes to", "[io]") {
    Mesh mesh = shapes::grid(149, 149); // 22,500 vertices of 508 bytes each, all alike
    mesh.attributes.push_back({"_FEATURES", Domain::vertex, Role::generic, 127, false,
                               std::vector<std::uint32_t>(mesh.vertex_count() * 127, 7)});
    const auto drc = test::written(test::scene_in_metres(mesh), "drc").files.at(0).bytes;
    CHECK(drc.size() < 60000);
    const Scene read = test::read_bytes(drc, "drc");
    CHECK(read.parts.at(0).mesh.vertex_count() == mesh.vertex_count());
    CHECK(read.parts.at(0).mesh.attributes.at(0).components == 127);
}

TEST_CASE("Draco rounds alike with and without fused multiply-add", "[io]") {
    // With as many bits as a float32 has, adding 1/2 rounds, and rounding once or twice differs often.
    const io::DracoGrid grid{{0.0F, -0.3F, 1e-3F}, 1.7F, 24};
    std::vector<float> numbers;
    for (int n = 0; n < 3000; ++n)
        for (const float origin : grid.origin)
            numbers.push_back(origin + 1.7F * static_cast<float>(n) / 3000);
    const auto step = [&](float x, float origin, bool fused) {
        const float along = x - origin, density = grid.density();
        if (fused) return std::floor(std::fma(along, density, 0.5F));
        const float product = along * density;
        return std::floor(product + 0.5F);
    };
    std::size_t differ = 0;
    std::vector<float> after = numbers;
    io::settle(after, grid);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const float origin = grid.origin[i % 3];
        differ += step(numbers[i], origin, true) != step(numbers[i], origin, false);
        CHECK(step(after[i], origin, true) == step(after[i], origin, false));
        CHECK(std::abs(after[i] - numbers[i]) <= 1e-6F);
    }
    CHECK(differ > 0);
}

TEST_CASE("the accessor of a Draco primitive has the bounds of the grid's own numbers", "[io]") {
    io::WriteSettings settings;
    settings.draco.on = true;
    Mesh mesh = shapes::icosphere(2);
    for (Vec3& p : mesh.positions) p = p * 0.37 + Vec3{3.1, -2.7, 0.9};
    const Scene scene = test::scene_in_metres(mesh);
    const Json json = Json::parse(test::json_of(test::written(scene, "glb", settings).files[0].bytes));
    const Json position =
        json["accessors"][json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    io::DracoInput input;
    io::set_draco_grid(mesh, input);
    const float step = input.range / 16383;
    for (std::size_t c = 0; c < 3; ++c)
        for (const char* end : {"min", "max"}) {
            const auto x = position[end][c].get<float>();
            const float along = std::round((x - input.origin[c]) / step) * step;
            CHECK(x == along + input.origin[c]);
        }
}

TEST_CASE("grids that Draco's six decimals hold", "[io]") {
    for (const float x : {0.1F, 1e-7F, -1e-7F, 3.1415927F, -12.3456789F, 9.87654321F, 5e8F, 0.0F, 1e-30F}) {
        INFO(x);
        const float below = io::storable_below(x), above = io::storable_above(x);
        CHECK(below <= x);
        CHECK(above >= std::max(x, 1e-6F));
        CHECK(std::stof(std::to_string(below)) == below);
        CHECK(std::stof(std::to_string(above)) == above);
        CHECK(x - below <= 2e-6F);
    }
    CHECK(io::bits_as_fine(14, 1.0F, 1.0F) == 14);
    CHECK(io::bits_as_fine(14, 1e-7F, 1e-6F) == 17);
    CHECK(io::bits_as_fine(14, 1e-30F, 1e-6F) == 30);
}

TEST_CASE("Draco takes meshes and attributes smaller than a millionth", "[io]") {
    io::WriteSettings settings;
    settings.draco.on = true;
    for (const double size : {1e-2, 1e-4, 1e-6, 1e-8}) {
        INFO(size);
        Mesh mesh = shapes::icosphere(2);
        for (Vec3& p : mesh.positions) p = p * size;
        std::vector<float> nearly_one;
        for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
            nearly_one.insert(nearly_one.end(), {1, static_cast<float>(v) * 1e-9F, 4e-8F, 1});
        mesh.attributes.push_back({"TANGENT", Domain::vertex, Role::tangent, 4, false, nearly_one});
        const Scene scene = test::scene_in_metres(mesh);
        const Mesh read = only_mesh(test::again(scene, settings));
        REQUIRE(read.vertex_count() == mesh.vertex_count());
        const double step = 1.25 * 2 * size / 16383;
        for (const Vec3& p : read.positions) CHECK(std::abs(length(p) - size) <= step);
        CHECK(read.find("TANGENT", Domain::wedge)->value(0, 0) == Approx(1));
    }
}

TEST_CASE("lines beside points are parts, and both keep their materials", "[io]") {
    const auto text = [](const char* more) {
        return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,1]}}],{}
 "nodes":[{{"mesh":0}},{{"mesh":1}}],"materials":[{{"name":"red","pbrMetallicRoughness":{{"baseColorFactor":[1,0,0,1]}}}},
 {{"name":"plain"}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"mode":0,"material":0,"extras":{{"a":1}}}}]}},
 {{"primitives":[{{"attributes":{{"POSITION":0}},"mode":3,"material":1}},{{"attributes":{{"POSITION":0}},"mode":0}}]}}],
 "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],
 "bufferViews":[{{"buffer":0,"byteLength":36}}],
 "buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}})",
                           more);
    };
    io::ReadLog log;
    const Scene scene = test::read_text(text(""), &log);
    CHECK(log.warnings.empty());
    REQUIRE(scene.parts.size() == 3);
    CHECK(broken_invariants(scene).empty());
    CHECK(scene.parts[0].mesh.line_count() == 0);
    CHECK(scene.materials.at(scene.parts[0].mesh.primitives.at(0).material).name == "red");
    CHECK(scene.parts[1].mesh.line_count() == 2);
    CHECK(scene.materials.at(scene.parts[1].mesh.primitives.at(0).material).name == "plain");
    CHECK(scene.parts[2].mesh.primitives.at(0).material == none);
    for (const Part& part : scene.parts) CHECK(part.document == 0);

    const Scene again = test::again(scene, {});
    REQUIRE(again.parts.size() == 3);
    const Json json = Json::parse(test::json_of(test::written(scene, "glb").files[0].bytes));
    CHECK(json["materials"].size() == 2);
    CHECK(json.dump().find("\"extras\":{\"a\":1}") != std::string::npos);
    const Part& points = again.parts[0];
    CHECK(points.mesh.line_count() == 0);
    CHECK(again.materials.at(points.mesh.primitives.at(0).material).base_colour[1] == 0);

    const std::string camera = R"("cameras":[{"type":"perspective","perspective":{"yfov":1,"znear":1}}],)";
    const Scene seen = test::read_text(text(camera.c_str()), &log);
    CHECK(log.warnings.empty());
    CHECK(Json::parse(test::json_of(test::written(seen, "glb").files[0].bytes))["cameras"].size() == 1);
    std::string targets = text("");
    targets.replace(targets.find("\"mode\":0"), 8, R"("mode":0,"targets":[{"POSITION":0}])");
    Scene morphed = test::read_text(targets, &log);
    CHECK(log.warnings.empty());
    for (const bool changed : {false, true}) {
        morphed.parts[0].changed = changed;
        const Json written = Json::parse(test::json_of(test::written(morphed, "glb").files[0].bytes));
        CHECK(written["meshes"][0]["primitives"][0]["targets"].size() == 1);
    }
}

TEST_CASE("lines and points beside triangles in one mesh get a mesh and a node of their own", "[io]") {
    const std::string text =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"materials":[{"name":"red"},{"name":"blue"}],
 "nodes":[{"name":"a","mesh":0,"translation":[5,0,0],"weights":[0.5]},{"mesh":0}],
 "meshes":[{"name":"m","weights":[0.25],"extras":{"targetNames":["up"],"other":1},"primitives":[
 {"attributes":{"POSITION":0},"targets":[{"POSITION":0}],"mode":3,"material":1},
 {"attributes":{"POSITION":0},"targets":[{"POSITION":0}],"material":0},
 {"attributes":{"POSITION":0},"targets":[{"POSITION":0}],"mode":0}]}],
 "animations":[{"samplers":[{"input":1,"output":1}],"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}},
 {"sampler":0,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":"/meshes/0/weights"}}}},
 {"sampler":0,"target":{"node":0,"path":"translation"}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
 {"bufferView":1,"componentType":5126,"count":1,"type":"SCALAR","min":[0],"max":[0]}],
 "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteLength":4}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
    io::ReadLog log;
    const Scene scene = test::read_text(text, &log);
    REQUIRE(scene.parts.size() == 6);
    CHECK(broken_invariants(scene).empty());
    const Part &faces = scene.parts[0], &lines = scene.parts[2], &points = scene.parts[3],
               &second = scene.parts[4];
    CHECK((points.name == "a_points" && points.mesh.vertex_count() == 3 && points.mesh.face_count() == 0));
    CHECK((faces.name == "a" && faces.mesh.face_count() == 1 && faces.mesh.line_count() == 0));
    CHECK((lines.name == "a_lines" && lines.mesh.face_count() == 0 && lines.mesh.line_count() == 2));
    CHECK(second.name == "m_lines");
    CHECK(lines.transform.point({}) == Vec3{5, 0, 0});
    CHECK(second.transform.point({}) == Vec3{});
    CHECK(scene.materials.at(lines.mesh.primitives.at(0).material).name == "blue");
    CHECK(scene.materials.at(faces.mesh.primitives.at(0).material).name == "red");

    const Json json = Json::parse(test::json_of(test::written(scene, "glb").files[0].bytes));
    CHECK(json["meshes"].size() == 3);
    CHECK(json["meshes"][1]["weights"] == Json{0.25});
    CHECK(json["nodes"][0]["children"] == Json{2, 3});
    CHECK(json["nodes"][2] == Json{{"name", "a_lines"}, {"mesh", 1}, {"weights", {0.5}}});
    CHECK(json["nodes"][3] == Json{{"name", "a_points"}, {"mesh", 2}, {"weights", {0.5}}});
    CHECK(json["nodes"][4] == Json{{"mesh", 1}});
    const Json& channels = json["animations"][0]["channels"];
    REQUIRE(channels.size() == 7);
    CHECK(channels[3]["target"] == Json{{"node", 2}, {"path", "weights"}});
    CHECK(channels[4]["target"] == Json{{"node", 3}, {"path", "weights"}});
    CHECK(channels[5]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] == "/meshes/1/weights");
    CHECK(channels[6]["target"]["extensions"]["KHR_animation_pointer"]["pointer"] == "/meshes/2/weights");
    CHECK(json["meshes"][1]["extras"] == Json::parse(R"({"targetNames":["up"]})"));
    Scene moved = scene;
    for (Vec3& p : moved.parts[2].mesh.positions) p.z += 1;
    moved.parts[2].changed = true;
    const Scene again = test::again(moved, {});
    REQUIRE(again.parts.size() == 6);
    CHECK(again.parts[2].mesh.positions.at(0).z == 1);
    CHECK(again.parts[4].mesh.positions.at(0).z == 0);

    const auto bytes = std::as_bytes(std::span(text));
    CHECK(io::file_header(io::Input::of("a.gltf", {bytes.begin(), bytes.end()}), {}).parts ==
          std::vector<std::string>{"a", "m", "a_lines", "a_points", "m_lines", "m_points"});
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string other = text;
        return other.replace(other.find(from), from.size(), to);
    };
    CHECK_THROWS_AS(test::read_text(with(R"({"mesh":0}])", R"({"mesh":1}])")), Error);
    CHECK_THROWS_AS(test::read_text(with(R"("nodes":[0,1])", R"("nodes":[0,2])")), Error);
}

TEST_CASE("nodes of lines and of points beside triangles are parts", "[io]") {
    const auto text = [](int mode) {
        return fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,1,2]}}],
 "nodes":[{{"mesh":0}},{{"mesh":1}},{{"mesh":1}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}},
 {{"primitives":[{{"attributes":{{"POSITION":0}},"mode":{}}}]}}],
 "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],
 "bufferViews":[{{"buffer":0,"byteLength":36}}],
 "buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}})",
                           mode);
    };
    io::ReadLog log;
    const Scene lines = test::read_text(text(3), &log);
    CHECK(log.warnings.empty());
    REQUIRE(lines.parts.size() == 3);
    CHECK(lines.parts[2].mesh.line_count() == 2);
    CHECK(lines.parts[2].node == 2);
    const Scene points = test::read_text(text(0), &log);
    CHECK(log.warnings.empty());
    REQUIRE(points.parts.size() == 3);
    CHECK(points.parts[2].mesh.vertex_count() == 3);
    CHECK(points.parts[2].source_mesh == points.parts[1].source_mesh);
}

TEST_CASE("scenes that refer to nothing do not keep a file from being read", "[io]") {
    const auto parts_of = [](const char* scenes) {
        const std::string text = std::string(R"({"asset":{"version":"2.0"},)") + scenes + R"(,
 "nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
 "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
 "bufferViews":[{"buffer":0,"byteLength":36}],
 "buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
        io::ReadLog log;
        const std::size_t parts = test::read_text(text, &log).parts.size();
        return std::pair(parts, log.warnings.size());
    };
    using Told = std::pair<std::size_t, std::size_t>; // parts, and warnings: W-GLTF, and W-SCENES
    for (const char* first :
         {R"("scene":7,"scenes":[{"nodes":[0]}])", R"("scene":null,"scenes":[{"nodes":[0]}])",
          R"("scene":"0","scenes":[{"nodes":[0]}])", R"("scene":-1,"scenes":[{"nodes":[0]}])",
          R"("scene":0,"scenes":[{"nodes":[99,0]}])"})
        CHECK(parts_of(first) == Told{1, 1});
    CHECK(parts_of(R"("scene":0,"scenes":[{"nodes":null}])") == Told{1, 2});
}

TEST_CASE("a part more asks for memory as often as its mesh and its document need it", "[io]") {
    const auto counts = [](std::size_t parts) { // for rewriting a file, and for reading it
        Scene scene = test::scene_in_metres(shapes::cube());
        for (std::size_t i = 1; i < parts; ++i) {
            Part part = scene.parts[0];
            part.mesh.positions[0].x -= static_cast<double>(i) / 1024;
            part.name = "part " + std::to_string(i);
            scene.parts.push_back(std::move(part));
        }
        const io::Bytes bytes = test::written(scene, "glb").files.at(0).bytes;
        const std::size_t before = allocations_of_thread();
        const Scene read = test::read_bytes(bytes, "glb");
        const std::size_t between = allocations_of_thread();
        CHECK(test::written(read, "glb").files.at(0).bytes == bytes);
        return std::pair(between - before, allocations_of_thread() - between);
    };
    const auto [read_few, written_few] = counts(50);
    const auto [read_many, written_many] = counts(150);
    CHECK(read_many - read_few < 100 * 68);
    CHECK(written_many - written_few < 100 * 80);
}

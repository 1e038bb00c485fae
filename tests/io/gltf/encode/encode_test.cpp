// Morph targets of primitives with different attributes, and weights that sum to nothing.
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;

namespace {

Attribute at_each_vertex(const char* name, Role role, int components, float value) {
    return {name,       Domain::wedge, role,
            components, false,         std::vector<float>(8 * static_cast<std::size_t>(components), value)};
}

} // namespace

TEST_CASE("targets displace only attributes that their primitive has", "[io]") {
    Mesh mesh = shapes::cube();
    mesh.attributes.push_back(at_each_vertex("NORMAL", Role::normal, 3, 0.6F));
    mesh.attributes.push_back(at_each_vertex("TEXCOORD_0", Role::uv, 2, 0.5F));
    mesh.attributes.push_back(at_each_vertex("TARGET_0_NORMAL", Role::morph_vector, 3, 0.1F));
    std::vector<std::uint32_t> primitive(mesh.face_count());
    primitive[0] = 1;
    mesh.attributes.push_back({"primitive", Domain::face, Role::index, 1, false, primitive});
    mesh.primitives = {{none, {"NORMAL"}, ""}, {none, {"TEXCOORD_0"}, ""}};
    for (const bool draco : {false, true}) {
        io::WriteSettings settings;
        settings.draco.on = draco;
        const auto glb = test::written(test::scene_in_metres(mesh), "glb", settings).files.at(0).bytes;
        const Json json = Json::parse(test::json_of(glb));
        const Json& primitives = json["meshes"][0]["primitives"];
        REQUIRE(primitives.size() == 2);
        CHECK(primitives[0]["targets"][0].contains("NORMAL"));
        CHECK_FALSE(primitives[1]["targets"][0].contains("NORMAL"));
        CHECK(primitives[1]["targets"][0].contains("POSITION"));
    }
}

TEST_CASE("a vertex without weights follows its first joint", "[io]") {
    Scene scene = test::scene_in_metres(shapes::cube());
    Mesh& mesh = scene.parts[0].mesh;
    mesh.attributes.push_back(
        {"JOINTS_0", Domain::wedge, Role::joints, 4, false, std::vector<std::uint8_t>(32)});
    mesh.attributes.push_back(at_each_vertex("WEIGHTS_0", Role::weights, 4, 0));
    for (const bool quantize : {false, true}) {
        io::WriteSettings settings;
        settings.quantize.on = quantize;
        const Scene back = test::again(scene, settings);
        const Attribute* weights = back.parts[0].mesh.find("WEIGHTS_0", Domain::wedge);
        REQUIRE(weights);
        CHECK(weights->value(0, 0) == 1);
        CHECK(weights->value(0, 1) == 0);
    }
}

#include "support/catch.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::refusal_of;
using test::run_stage;
using test::scene_of;

namespace {

/// A cube whose material has a texture.
Scene textured_cube() {
    Scene scene = scene_of(shapes::uv_cube());
    auto document = std::make_shared<Document>();
    document->json = R"({"asset":{"version":"2.0"},"images":[{"uri":"a.png"}],"textures":[{"source":0}],
        "materials":[{"name":"paint","pbrMetallicRoughness":{"baseColorTexture":{"index":0}},
                      "normalTexture":{"index":0,"texCoord":1}}]})";
    scene.documents.push_back(document);
    scene.materials.push_back({.name = "paint", .document = 0, .index = 0});
    scene.parts[0].mesh.primitives.push_back({.material = 0, .attributes = {}, .json = {}});
    return scene;
}

} // namespace

TEST_CASE("unwrap: reports what it made", "[stages]") {
    const auto run =
        run_stage("unwrap", "{texels_per_m: 64, gutter: 2}", scene_of(shapes::quad_cube(), Unit::m));
    CHECK(run.record.result["parts"] == 1);
    CHECK(run.record.result["texels_per_m"] == 64);
    CHECK(run.record.result["texture"] == 256);
    CHECK(run.mesh().all_triangles());
    CHECK(run.mesh().find("TEXCOORD_0", Domain::wedge));
    CHECK(run.warnings().empty());
}

TEST_CASE("unwrap: textures follow the coordinates that are kept", "[stages]") {
    CHECK(run_stage("unwrap", "64", textured_cube()).warnings() ==
          std::vector<std::string>{"W-UNWRAP-TEXTURES"});
    CHECK_THROWS_WITH(run_stage("unwrap", "{set: 2}", textured_cube()),
                      Catch::Matchers::Contains("needs a set 1 before it"));
    const auto run = run_stage("unwrap", "{texture: 64, keep: true}", textured_cube());
    CHECK(run.warnings().empty());
    CHECK(run.mesh().find("TEXCOORD_1", Domain::wedge));
    const Json document = Json::parse(run.scene.documents[0]->json);
    const Json& material = document["materials"][0];
    CHECK(material["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] == 1);
    CHECK(material["normalTexture"]["texCoord"] == 2);
}

TEST_CASE("unwrap: a density needs a unit, and no size", "[stages]") {
    CHECK(refusal_of("unwrap", "{texels_per_m: 64}", scene_of(shapes::cube())).find("E-UNIT") !=
          std::string::npos);
    CHECK(refusal_of("unwrap", "{texels_per_m: 64, texture: 64}", scene_of(shapes::cube(), Unit::m))
              .find("gives the size of the texture") != std::string::npos);
}

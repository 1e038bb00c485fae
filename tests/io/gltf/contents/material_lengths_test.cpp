// KHR_materials_volume: the thickness is in the space of the mesh, the attenuation distance in the world.
#include "diff/comparison.hpp"
#include "io/gltf/gltf.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using namespace facetmill::test;

namespace {

/// Glass at scales of 2, 1 and 0.5: light passes 1, 0.5 and 0.25 metres.
Scene three_glasses() {
    return read_text(
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1,2]}],
"nodes":[{"mesh":0,"scale":[2,2,2]},{"mesh":1,"translation":[4,0,0]},{"mesh":2,"translation":[8,0,0],"scale":[0.5,0.5,0.5]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]},{"primitives":[{"attributes":{"POSITION":0},"material":0}]},{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"extensions":{"KHR_materials_volume":{"thicknessFactor":0.5,"attenuationDistance":0.3}}}],
"extensionsUsed":["KHR_materials_volume"],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})");
}

/// All thicknesses, ascending.
std::vector<double> all_thicknesses(const Scene& scene) {
    std::vector<double> all;
    for (const auto& part : io::thicknesses(scene)) all.insert(all.end(), part.begin(), part.end());
    std::sort(all.begin(), all.end());
    return all;
}

void check_thickness(const Scene& scene, double factor = 1) {
    const auto found = all_thicknesses(scene);
    REQUIRE(found.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(found[i] == Approx(factor * (0.25 * double(1 << i))).epsilon(1e-6));
}

} // namespace

TEST_CASE("quantized glass stays as thick as it was", "[io]") {
    for (const bool meshopt : {false, true})
        for (const bool even : {false, true}) {
            io::WriteSettings settings;
            settings.quantize.on = true;
            settings.meshopt.on = meshopt;
            if (even) settings.lattices.assign(3, {{0, 0, 0}, 0x1p-14});
            check_thickness(again(three_glasses(), settings));
        }
}

TEST_CASE("merged and baked glass stays as thick as it was", "[stages]") {
    check_thickness(again(run_stage("transform", "{bake: true}", three_glasses()).scene));
    check_thickness(run_stage("optimize", "", three_glasses()).scene);
    const auto merged = run_stage("merge", "", three_glasses());
    CHECK(merged.scene.parts.size() == 1);
    check_thickness(again(merged.scene));
    CHECK(again(merged.scene).parts[0].mesh.primitives.size() == 3);
}

TEST_CASE("glass that is scaled in the world absorbs as before", "[stages]") {
    for (const char* options : {"{scale: 0.1}", "{scale: 0.1, bake: true}"}) {
        const auto run = run_stage("transform", options, three_glasses());
        check_thickness(run.scene, 0.1);
        const Json document = Json::parse(run.scene.documents[0]->json);
        for (const Json& material : document["materials"])
            CHECK(material["extensions"]["KHR_materials_volume"]["attenuationDistance"] == 0.03);
    }
}

TEST_CASE("the comparison sees another thickness", "[report]") {
    const auto differs = [](const Scene& a, const Scene& b) {
        for (const auto& line : report::compare(a, b).lines)
            if (line.name.starts_with("thickness") && !line.same) return true;
        return false;
    };
    io::WriteSettings settings;
    settings.quantize.on = true;
    CHECK_FALSE(differs(three_glasses(), again(three_glasses(), settings)));
    Scene thinner = three_glasses();
    thinner.parts[1].transform.m[0][0] = thinner.parts[1].transform.m[1][1] =
        thinner.parts[1].transform.m[2][2] = 0.99;
    CHECK(differs(three_glasses(), thinner));
}

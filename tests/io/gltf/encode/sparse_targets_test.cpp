// Morph targets that displace few vertices become sparse accessors, which read back to the same numbers.
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;

namespace {

/// A torus whose target displaces every n-th vertex.
Scene displaced(std::size_t n) {
    Mesh mesh = shapes::torus(24, 16);
    std::vector<float> numbers(3 * mesh.vertex_count());
    for (std::size_t i = 0; i < numbers.size(); i += 3 * n) numbers[i + 1] = 0.1F + static_cast<float>(i % 5);
    mesh.attributes.push_back(
        {"TARGET_0_POSITION", Domain::vertex, Role::morph_vector, 3, false, std::move(numbers)});
    return test::scene_in_metres(mesh);
}

Json accessor_of_target(const io::Bytes& glb) {
    const Json json = Json::parse(test::json_of(glb));
    return json["accessors"][json["meshes"][0]["primitives"][0]["targets"][0]["POSITION"].get<std::size_t>()];
}

std::vector<float> target_of(const Scene& scene) {
    const Attribute* found = nullptr;
    for (const Attribute& a : scene.parts.at(0).mesh.attributes)
        if (a.name == "TARGET_0_POSITION") found = &a;
    REQUIRE(found);
    std::vector<float> all;
    for (std::size_t i = 0; i < found->size(); ++i)
        for (int c = 0; c < 3; ++c) all.push_back(static_cast<float>(found->value(i, c)));
    return all;
}

} // namespace

TEST_CASE("few displaced vertices make a sparse target, many do not", "[io]") {
    for (const bool quantize : {false, true}) {
        io::WriteSettings settings;
        settings.quantize.on = quantize;
        settings.order = io::TriangleOrder::keep;
        const io::Bytes few = test::written(displaced(40), "glb", settings).files.at(0).bytes,
                        many = test::written(displaced(1), "glb", settings).files.at(0).bytes;
        const Json sparse = accessor_of_target(few);
        REQUIRE(sparse.contains("sparse"));
        CHECK_FALSE(sparse.contains("bufferView"));
        CHECK(sparse["count"] == 384);
        CHECK(sparse["sparse"]["count"] == 10);
        CHECK(sparse["sparse"]["indices"]["componentType"] == 5123);
        CHECK_FALSE(accessor_of_target(many).contains("sparse"));
        const Scene back = test::read_bytes(few, "glb");
        CHECK(target_of(back).size() == target_of(displaced(40)).size());
        if (!quantize) CHECK(target_of(back) == target_of(displaced(40)));
        // A sparse target stays sparse, and keeps its numbers.
        const io::Bytes twice = test::written(back, "glb", settings).files.at(0).bytes;
        CHECK(accessor_of_target(twice).contains("sparse"));
        CHECK(target_of(test::read_bytes(twice, "glb")) == target_of(back));
    }
}

TEST_CASE("targets stay dense under meshopt, which stores zeros in almost no bytes", "[io]") {
    io::WriteSettings settings;
    settings.meshopt.on = true;
    const io::Bytes bytes = test::written(displaced(40), "glb", settings).files.at(0).bytes;
    CHECK_FALSE(accessor_of_target(bytes).contains("sparse"));
}

// Morphed parts as pictures show them; skinned ones are in skins_test.cpp.
#include "io/gltf/read/skinned_pose.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"

using namespace facetmill;

namespace {

/// A square in z = 0 with a morph target that lifts it by 2. The default weight is the mesh's or the node's.
Scene morphed(const Json& of_mesh, const Json& of_node) {
    Mesh mesh = shapes::grid(1, 1);
    std::vector<float> lifts;
    for (Index v = 0; v < mesh.vertex_count(); ++v) lifts.insert(lifts.end(), {0, 0, 2});
    mesh.attributes.push_back(
        {"TARGET_0_POSITION", Domain::wedge, Role::morph_vector, 3, false, std::move(lifts)});
    Scene scene = test::again(test::scene_in_metres(std::move(mesh)));
    Document document = *scene.documents.at(0);
    Json json = Json::parse(document.json);
    if (!of_mesh.is_null()) json["meshes"][0]["weights"] = of_mesh;
    if (!of_node.is_null()) json["nodes"][0]["weights"] = of_node;
    document.json = json.dump();
    scene.documents[0] = std::make_shared<const Document>(std::move(document));
    return scene;
}

} // namespace

TEST_CASE("morphed parts are shown by their default weights", "[io]") {
    CHECK_FALSE(io::posed(morphed(nullptr, nullptr)));
    CHECK_FALSE(io::posed(morphed({0.0}, nullptr)));
    const Scene scene = morphed({0.5}, nullptr);
    const auto half = io::posed(scene);
    REQUIRE(half);
    CHECK(half->bounds().min.z == 1);
    CHECK(scene.bounds().min.z == 0);
    const auto of_node = io::posed(morphed({0.5}, {-1.0}));
    REQUIRE(of_node);
    CHECK(of_node->bounds().min.z == -2);
    CHECK_FALSE(io::posed(test::scene_in_metres(shapes::cube())));
}

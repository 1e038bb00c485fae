// Features and metadata of 3D Tiles through stages and encodings.
#include "support/catch.hpp"

#include "base/json.hpp"
#include "io/gltf/document/container.hpp"
#include "mesh/shapes.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <cmath>
#include <set>

namespace features_test {

using namespace facetmill;

/// A wavy grid whose vertices belong to the features 3, 10, 17 ... by column, `step` apart.
Mesh fields(float step = 7) {
    Mesh mesh = shapes::grid(20, 20);
    std::vector<float> ids;
    const Box box = mesh.bounds();
    for (Vec3& p : mesh.positions) {
        const double u = (p.x - box.min.x) / (box.max.x - box.min.x);
        p.z += 0.05 * u * u;
        ids.push_back(3 + step * static_cast<float>(std::floor(3.999 * u)));
    }
    mesh.attributes.push_back({"_FEATURE_ID_0", Domain::vertex, Role::index, 1, false, std::move(ids)});
    mesh.primitives.resize(1);
    mesh.primitives[0].json =
        R"({"extensions":{"EXT_mesh_features":{"featureIds":[{"featureCount":4,"attribute":0,"propertyTable":0}]}}})";
    return mesh;
}

/// The grid in a file with a property table, which has 1, 2, 3, 4 in float32 for the features.
Scene with_table(Mesh mesh) {
    const io::Bytes glb = test::written(test::scene_in_metres(std::move(mesh)), "glb").files.at(0).bytes;
    Json json = Json::parse(test::json_of(glb));
    const io::gltf::Chunks chunks = io::gltf::split_glb(glb);
    io::Bytes binary(chunks.binary->begin(), chunks.binary->end());
    const std::size_t at = binary.size();
    const float values[] = {1, 2, 3, 4};
    binary.resize(at + sizeof values);
    std::memcpy(binary.data() + at, values, sizeof values);
    json["meshes"][0]["primitives"][0]["extensions"]["EXT_mesh_features"]["featureIds"].push_back(
        {{"featureCount", 441}});
    json["buffers"][0]["byteLength"] = binary.size();
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", sizeof values}});
    json["extensionsUsed"].push_back("EXT_structural_metadata");
    json["extensions"]["EXT_structural_metadata"] = {
        {"schema",
         {{"id", "s"}, {"classes", {{"field", {{"properties", {{"yield", {{"type", "SCALAR"}}}}}}}}}}},
        {"propertyTables",
         {{{"class", "field"},
           {"count", 4},
           {"properties", {{"yield", {{"values", json["bufferViews"].size() - 1}}}}}}}}};
    return test::read_bytes(io::gltf::join_glb(json.dump(), binary), "glb");
}

std::set<double> ids_of(const Mesh& mesh) {
    const Attribute* a = mesh.find("_FEATURE_ID_0", Domain::wedge);
    REQUIRE(a);
    CHECK(a->role == Role::index);
    std::set<double> ids;
    for (Index w = 0; w < mesh.wedge_count(); ++w) ids.insert(a->value(w, 0));
    return ids;
}

/// The values of the table, from the buffer view that it refers to.
std::vector<float> table_of(const io::Bytes& glb) {
    const Json json = Json::parse(test::json_of(glb));
    const io::gltf::Chunks chunks = io::gltf::split_glb(glb);
    const auto view =
        json.at(Json::json_pointer("/extensions/EXT_structural_metadata/propertyTables/0/properties/"
                                   "yield/values"))
            .get<std::size_t>();
    std::vector<float> values(4);
    const Json& of = json["bufferViews"][view];
    REQUIRE(of["byteLength"] == 16);
    std::memcpy(values.data(), chunks.binary->data() + of.value("byteOffset", std::size_t{0}), 16);
    return values;
}

const Json::json_pointer ids_place("/meshes/0/primitives/0/extensions/EXT_mesh_features/featureIds");

TEST_CASE("features and their tables survive stages that change the mesh", "[io]") {
    const std::pair<const char*, const char*> stages[] = {
        {"clip", "x=30%"}, {"simplify", "20%"}, {"split", "midpoint"}, {"relax", "2"}};
    for (const auto& [stage, option] : stages) {
        INFO(stage);
        const Scene changed = test::run_stage(stage, option, with_table(fields())).scene;
        const io::Written written = test::written(changed, "glb");
        REQUIRE(written.warnings.size() == 1);
        CHECK(written.warnings[0].message ==
              "part 'thing': feature ids by the number of the vertex of EXT_mesh_features of a primitive are "
              "dropped, because the mesh has changed");
        const io::Bytes& glb = written.files[0].bytes;
        const Json json = Json::parse(test::json_of(glb));
        CHECK(json.at(ids_place) == Json::parse(R"([{"featureCount":4,"attribute":0,"propertyTable":0}])"));
        CHECK(json["meshes"].size() == 1); // the old table is removed completely
        CHECK(table_of(glb) == std::vector<float>{1, 2, 3, 4});
        for (const double id : ids_of(test::read_bytes(glb, "glb").parts.at(0).mesh))
            CHECK(std::set<double>{3, 10, 17, 24}.contains(id));
    }
}

TEST_CASE("no encoding rounds the numbers of features", "[io]") {
    for (const float step : {7.0F, 4001.0F, 100001.0F}) {
        const Scene scene = with_table(fields(step));
        const std::set<double> given = ids_of(scene.parts.at(0).mesh);
        CHECK(given.size() == 4);
        io::WriteSettings draco, quantize, meshopt;
        draco.draco.on = true;
        quantize.quantize.on = true;
        meshopt.quantize.on = true;
        meshopt.meshopt.on = true;
        for (const io::WriteSettings& settings : {draco, quantize, meshopt}) {
            const io::Bytes glb = test::written(scene, "glb", settings).files[0].bytes;
            CHECK(ids_of(test::read_bytes(glb, "glb").parts.at(0).mesh) == given);
            CHECK(table_of(glb) == std::vector<float>{1, 2, 3, 4});
        }
    }
}

TEST_CASE("features whose numbers are gone, or are of another document, are dropped by name", "[io]") {
    Scene scene = with_table(fields());
    scene.parts[0].mesh.drop("_FEATURE_ID_0", Domain::wedge);
    scene.parts[0].changed = true;
    const io::Written without = test::written(scene, "glb");
    REQUIRE(without.warnings.size() == 1);
    CHECK(without.warnings[0].id == "W-EXTENSION");
    CHECK(without.warnings[0].message.find("feature ids, because _FEATURE_ID_0 is missing") !=
          std::string::npos);
    CHECK(!Json::parse(test::json_of(without.files[0].bytes)).contains(ids_place));

    Scene first = with_table(fields());
    Scene second = with_table(fields());
    second.parts[0].document = 1;
    first.documents.push_back(second.documents[0]);
    first.parts.push_back(second.parts[0]);
    const io::Written both = test::written(first, "glb");
    std::size_t dropped = 0;
    for (const auto& warning : both.warnings) dropped += warning.id == "W-EXTENSION";
    CHECK(dropped > 0);
}

} // namespace features_test

// Interleaved attributes: the same numbers as in separate views, in views that glTF allows.
#include "io/codec.hpp"
#include "io/gltf/document/accessor.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/gltf.hpp"
#include "support/run_stage.hpp"

#include <set>

using namespace facetmill;

namespace {

/// A torus with numbers of several types, and a morph target.
Scene many_attributes(int generic) {
    Mesh mesh = shapes::torus(16, 12);
    const auto add = [&](std::string name, Role role, int components, auto one) {
        std::vector<decltype(one)> numbers;
        for (std::size_t i = 0; i < mesh.vertex_count() * static_cast<std::size_t>(components); ++i)
            numbers.push_back(static_cast<decltype(one)>(one + static_cast<decltype(one)>(i % 7)));
        mesh.attributes.push_back(
            {std::move(name), Domain::vertex, role, components, false, std::move(numbers)});
    };
    add("NORMAL", Role::normal, 3, 1.0F);
    add("TEXCOORD_0", Role::uv, 2, 0.25F);
    add("JOINTS_0", Role::joints, 4, std::uint8_t{1});
    add("WEIGHTS_0", Role::weights, 4, 0.25F);
    add("TARGET_0_POSITION", Role::morph_vector, 3, 0.5F);
    add("_short", Role::generic, 1, std::uint16_t{3}); // 2 bytes, which are padded
    for (int i = 0; i < generic; ++i)
        add("_g" + std::to_string(i), Role::generic, 4, 0.5F + static_cast<float>(i));
    return test::scene_in_metres(mesh);
}

Json json_written(const Scene& scene, bool quantize, bool interleave, io::Bytes* bytes = nullptr) {
    io::WriteSettings settings;
    settings.quantize.on = quantize;
    settings.interleave = interleave;
    const io::Written written = test::written(scene, "glb", settings);
    CHECK(written.warnings.empty());
    if (bytes) *bytes = written.files.at(0).bytes;
    return Json::parse(test::json_of(written.files.at(0).bytes));
}

/// The number of buffer views with attributes of a primitive. Checks that all of them follow glTF's rules.
std::size_t views_of(const Json& json, const Json& attributes) {
    std::set<std::size_t> views;
    for (const auto& [name, reference] : attributes.items()) {
        const Json& accessor = json["accessors"][reference.get<std::size_t>()];
        const auto view = accessor["bufferView"].get<std::size_t>();
        const auto stride = json["bufferViews"][view].value("byteStride", std::size_t{0});
        views.insert(view);
        CHECK(stride <= 252);
        CHECK(stride % 4 == 0);
        CHECK(accessor.value("byteOffset", std::size_t{0}) % 4 == 0);
        CHECK(json["bufferViews"][view]["target"] == 34962);
    }
    return views.size();
}

} // namespace

TEST_CASE("interleaved attributes have the numbers that they have apart", "[io]") {
    for (const bool quantize : {false, true})
        for (const int generic : {0, 20}) {
            INFO(quantize << generic);
            const Scene scene = many_attributes(generic);
            io::Bytes apart, together;
            const Json before = json_written(scene, quantize, false, &apart),
                       after = json_written(scene, quantize, true, &together);
            const Json& primitive = after["meshes"][0]["primitives"][0];
            CHECK(views_of(after, primitive["attributes"]) == (generic > 0 ? 2 : 1));
            CHECK(views_of(before, before["meshes"][0]["primitives"][0]["attributes"]) > 5);
            CHECK(after["accessors"].size() == before["accessors"].size());
            CHECK(together.size() < apart.size()); // fewer views to declare
            const Scene a = test::read_bytes(apart, "glb"), b = test::read_bytes(together, "glb");
            CHECK(test::drawn(a.parts.at(0).mesh) == test::drawn(b.parts.at(0).mesh));
            // The morph target has its own view.
            const auto target = primitive["targets"][0]["POSITION"].get<std::size_t>();
            CHECK_FALSE(after["accessors"][target].contains("byteOffset"));
            // Interleaving a second time changes nothing. Without the option, only rewritten attributes are
            // separated.
            io::Bytes again;
            json_written(b, quantize, true, &again);
            CHECK((again == together));
        }
}

TEST_CASE("primitives that share an attribute share the interleaved view", "[io]") {
    Json json = json_written(many_attributes(0), false, false);
    const Scene scene = [&] {
        io::Bytes bytes;
        json_written(many_attributes(0), false, false, &bytes);
        const Scene one = test::read_bytes(bytes, "glb");
        Json primitive = json["meshes"][0]["primitives"][0];
        primitive["attributes"].erase("TEXCOORD_0");
        primitive["mode"] = 0; // points, which stay unchanged
        json["meshes"][0]["primitives"].push_back(primitive);
        Scene changed = one;
        auto document = std::make_shared<Document>(*one.documents.at(0));
        document->json = json.dump();
        changed.documents[0] = document;
        return changed;
    }();
    const Json after = json_written(scene, false, true);
    const Json &first = after["meshes"][0]["primitives"][0], &second = after["meshes"][0]["primitives"][1];
    CHECK(first["attributes"]["POSITION"] == second["attributes"]["POSITION"]);
    CHECK(views_of(after, first["attributes"]) == 1);
    CHECK(views_of(after, second["attributes"]) == 1);
    CHECK(after["accessors"].size() == json["accessors"].size());
}

TEST_CASE("interleave goes with neither draco nor meshopt, nor with other formats", "[io]") {
    using test::options;
    for (const char* other : {"draco", "meshopt"})
        CHECK(
            test::problems_of("write", options({{"path", "a.glb"}, {"interleave", "true"}, {other, "true"}}))
                .find(std::string("'interleave' and '") + other + "' exclude each other") !=
            std::string::npos);
    CHECK(test::problems_of("write", options({{"path", "a.ply"}, {"interleave", "true"}}))
              .find("'interleave' works with") != std::string::npos);
}

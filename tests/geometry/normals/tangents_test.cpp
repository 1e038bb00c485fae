// Tangents of MikkTSpace. The expected numbers come from its reference implementation (npm mikktspace
// 1.1.1). The sign of the bitangent is reversed, because v points down in glTF.
#include "support/catch.hpp"

#include "geometry/normals/tangents.hpp"
#include "mesh/invariants.hpp"
#include "mesh/shapes.hpp"
#include "support/bench.hpp"
#include "support/gltf.hpp"
#include "support/images.hpp"

#include "io/images/png.hpp"

using namespace facetmill;

namespace {

/// A roof of four triangles around an apex, whose texture is mirrored across y.
Mesh roof() {
    Mesh mesh;
    mesh.positions = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
    mesh.corners = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
    std::vector<float> normals;
    for (const Vec3& p : mesh.positions) {
        const Vec3 n = normalised(p + Vec3{0, 0, 1});
        for (std::size_t c = 0; c < 3; ++c) normals.push_back(static_cast<float>(n[c]));
    }
    mesh.attributes = {{"NORMAL", Domain::wedge, Role::normal, 3, false, std::move(normals)},
                       {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false,
                        std::vector<float>{0, 0, 1, 0.25F, 0.25F, 1, 1, 0.25F, 0.25F, -1}}};
    return mesh;
}

constexpr double of_roof[12][4] = {
    {0.970142, -0.242536, 0, -1}, {0.695984, -0.176672, -0.695984, -1}, {0.942809, 0.235702, -0.235702, -1},
    {-0.970142, -0.242536, 0, 1}, {-0.942809, 0.235702, -0.235702, 1},  {-0.695984, -0.176672, -0.695984, 1},
    {-0.970142, -0.242536, 0, 1}, {-0.695984, -0.176672, -0.695984, 1}, {-0.685994, -0.514496, -0.514496, 1},
    {0.970142, -0.242536, 0, -1}, {0.685994, -0.514496, -0.514496, -1}, {0.695984, -0.176672, -0.695984, -1}};

} // namespace

TEST_CASE("tangents are those of MikkTSpace, also where the texture is mirrored", "[geometry]") {
    Mesh mesh = roof();
    CHECK_FALSE(give_tangents(mesh, 1)); // this set of texture coordinates does not exist
    REQUIRE(give_tangents(mesh, 0));
    const Attribute* tangents = mesh.find("TANGENT", Domain::wedge);
    REQUIRE(tangents);
    for (Index c = 0; c < 12; ++c)
        for (int k = 0; k < 4; ++k)
            CHECK(std::abs(tangents->value(mesh.corners[c], k) - of_roof[c][k]) < 2e-6);
    CHECK(mesh.wedge_count() == 8); // apex, two ends of the ridge, of either hand
    CHECK(mesh.vertex_count() == 5);
    CHECK(broken_invariants(mesh).empty());
}

TEST_CASE("tangents without a direction are of length 1 all the same", "[geometry]") {
    Mesh mesh = roof();
    std::get<std::vector<float>>(mesh.find("TEXCOORD_0", Domain::wedge)->data).assign(10, 0.5F);
    mesh.corners.insert(mesh.corners.end(), {0, 0, 1}); // a face without area
    REQUIRE(give_tangents(mesh, 0));
    const Attribute* tangents = mesh.find("TANGENT", Domain::wedge);
    for (Index w = 0; w < mesh.wedge_count(); ++w) CHECK(tangents->value(w, 0) == 1);
    Mesh none;
    CHECK_FALSE(give_tangents(none, 0));
}

TEST_CASE("write makes tangents where a material has a map of normals", "[stages]") {
    const auto scene = [](const char* material) {
        const io::Bytes plain = test::written(test::scene_in_metres(roof()), "glb").files[0].bytes;
        Json json = Json::parse(test::json_of(plain));
        json["images"] = {{{"uri", "data:image/png;base64," + io::base64(test::to_bytes(test::red_png()))}}};
        json["textures"] = {{{"source", 0}}};
        json["materials"] = Json::array({Json::parse(material)});
        json["meshes"][0]["primitives"][0]["material"] = 0;
        json["buffers"][0]["uri"] = "data:application/octet-stream;base64," +
                                    io::base64(io::Span(plain).subspan(
                                        plain.size() - json["buffers"][0]["byteLength"].get<std::size_t>()));
        return test::read_text(json.dump());
    };
    const auto written_with = [&](const Scene& given, const char* tangents) {
        test::Bench b;
        b.scene = given;
        b.run("write", test::options({{"path", "a.glb"}, {"tangents", tangents}}));
        CHECK_FALSE(b.scene.parts[0].mesh.find("TANGENT", Domain::wedge)); // the scene keeps its own
        b.state.outputs.commit();
        test::Bench again;
        again.state.places = b.state.places;
        again.run("load", Value::scalar("a.glb"));
        return again.scene.parts[0].mesh.find("TANGENT", Domain::wedge) != nullptr;
    };
    const Scene mapped = scene(R"({"normalTexture":{"index":0}})");
    CHECK(written_with(mapped, "missing"));
    CHECK(written_with(mapped, "new"));
    CHECK_FALSE(written_with(mapped, "keep"));
    CHECK_FALSE(written_with(scene(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})"), "new"));
}

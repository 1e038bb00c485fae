#include "base/json.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/images/pixels.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/off_file.hpp"
#include "support/run_stage.hpp"

using namespace facetmill;
using test::options;
using test::run_stage;
using test::scene_of;

namespace {

constexpr const char* red_square =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
    "property list uchar int vertex_indices\nend_header\n"
    "0 0 0 200 0 10\n1 0 0 200 0 10\n1 1 0 200 0 10\n0 1 0 200 0 10\n3 0 1 2\n3 0 2 3\n";

Mesh square(double z = 0) {
    Mesh mesh;
    mesh.positions = {{0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}};
    mesh.corners = {0, 1, 2, 0, 2, 3};
    mesh.attributes.push_back(
        {"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}});
    return mesh;
}

} // namespace

TEST_CASE("bake: the part gets one material with the maps", "[stages][bake]") {
    const test::TemporaryDirectory folder;
    test::put(folder / "from.ply", red_square);
    const auto r = run_stage("bake", options({{"size", "16"}, {"from", (folder / "from.ply").string()}}),
                             scene_of(square(0.01)));
    CHECK(r.warnings().empty());
    CHECK(r.record.result["missed_texels"] == 0);
    CHECK(r.record.result["covered_texels"] == 256);
    REQUIRE(r.scene.materials.size() == 1);
    REQUIRE(r.mesh().primitives.size() == 1);
    CHECK(r.mesh().primitives[0].material == 0);
    CHECK(r.mesh().find("TANGENT", Domain::wedge) != nullptr);
    const auto images = io::document_images(*r.scene.documents[0], {});
    REQUIRE(!images.empty());
    const auto pixels = io::decoded_image(images[0].bytes);
    REQUIRE(pixels.has_value());
    CHECK(pixels->width == 16);
    CHECK(pixels->rgba[0] == 200);
    CHECK(pixels->rgba[1] == 0);
    CHECK(pixels->rgba[2] == 10);
}

TEST_CASE("bake: without texture coordinates, the error names unwrap", "[stages][bake]") {
    const test::TemporaryDirectory folder;
    test::put(folder / "from.ply", red_square);
    const Value use = options({{"from", (folder / "from.ply").string()}});
    const std::string none = test::failure([&] { run_stage("bake", use, scene_of(shapes::cube())); });
    CHECK(none.find("E-BAKE-UV") != std::string::npos);
    CHECK(none.find("use unwrap before bake") != std::string::npos);
    Mesh outside = square();
    outside.find("TEXCOORD_0", Domain::wedge)->set_value(2, 0, 3);
    const std::string far = test::failure([&] { run_stage("bake", use, scene_of(outside)); });
    CHECK(far.find("2 faces outside of the unit square") != std::string::npos);
}

TEST_CASE("bake: without a loaded scene it needs a file", "[stages][bake]") {
    const std::string text = test::failure([&] { run_stage("bake", "64", scene_of(square())); });
    CHECK(text.find("E-BAKE-SOURCE") != std::string::npos);
}

TEST_CASE("bake: overlaps and a distant source give warnings", "[stages][bake]") {
    const test::TemporaryDirectory folder;
    test::put(folder / "from.ply", red_square);
    const Value use = options({{"size", "16"}, {"from", (folder / "from.ply").string()}});
    Mesh twice = square();
    append(twice, square());
    const auto r = run_stage("bake", use, scene_of(twice));
    CHECK(r.warnings() == std::vector<std::string>{"W-BAKE-OVERLAP"});
    CHECK(r.record.result["overlapping_faces"] == 4);
    const auto far = run_stage("bake", use, scene_of(square(5)));
    CHECK(far.warnings() == std::vector<std::string>{"W-BAKE-FAR"});
}

TEST_CASE("bake: heights are written with 16 bits, with their range", "[stages][bake]") {
    const test::TemporaryDirectory folder;
    test::put(folder / "from.ply", red_square);
    const auto r = run_stage("bake",
                             options({{"size", "16"},
                                      {"from", (folder / "from.ply").string()},
                                      {"height", (folder / "height.png").string()}}),
                             scene_of(square(-0.25)));
    REQUIRE(r.record.result.contains("height"));
    CHECK(r.record.result["height"]["white"].get<double>() == Approx(0.25));
    CHECK(r.record.result["height"]["black"].get<double>() == Approx(0.25));
}

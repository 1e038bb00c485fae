#include "geometry/normals/unit_vectors.hpp"

#include "mesh/shapes.hpp"
#include "support/catch.hpp"

#include <limits>

using namespace facetmill;

namespace {

Mesh triangle_with(Attribute a) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.corners = {0, 1, 2};
    mesh.attributes = {std::move(a)};
    return mesh;
}

Mesh skinned_triangle(std::vector<std::uint8_t> joints, AttributeData weights, bool normalised) {
    Mesh mesh = triangle_with({"JOINTS_0", Domain::wedge, Role::joints, 4, false, std::move(joints)});
    mesh.attributes.push_back({"WEIGHTS_0", Domain::wedge, Role::weights, 4, normalised, std::move(weights)});
    return mesh;
}

} // namespace

TEST_CASE("unit vectors: normals get length 1, and tangents a sign", "[normals]") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Mesh mesh = triangle_with(
        {"NORMAL", Domain::wedge, Role::normal, 3, false, std::vector<float>{0, 0, 2, nan, 0, 0, 0, 0, 1}});
    mesh.attributes.push_back({"TANGENT", Domain::wedge, Role::tangent, 4, false,
                               std::vector<float>{3, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, -1}});
    std::size_t mended = 0;
    const AttributeChanges changes = scale_to_unit(mesh, mended);
    CHECK(mended == 4);
    CHECK(std::get<std::vector<float>>(mesh.attributes[0].data) ==
          std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
    CHECK(std::get<std::vector<float>>(mesh.attributes[1].data) ==
          std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1});
    REQUIRE(changes.size() == 2);
    CHECK(changes[0].kind == AttributeChange::Kind::recomputed);
}

TEST_CASE("unit vectors: weights of floats sum to 1, and joints are there once", "[normals]") {
    Mesh mesh =
        skinned_triangle({0, 1, 0, 2, 5, 0, 0, 0, 3, 4, 0, 0},
                         std::vector<float>{0.25F, 0.25F, 0.25F, 0.25F, 0, 0, 0, 0, 2, -1, 2, 0}, false);
    std::size_t mended = 0;
    static_cast<void>(scale_to_unit(mesh, mended));
    CHECK(mended == 3);
    CHECK(std::get<std::vector<std::uint8_t>>(mesh.attributes[0].data) ==
          std::vector<std::uint8_t>{0, 1, 0, 2, 5, 0, 0, 0, 3, 0, 0, 0});
    CHECK(std::get<std::vector<float>>(mesh.attributes[1].data) ==
          std::vector<float>{0.5F, 0.25F, 0, 0.25F, 1, 0, 0, 0, 0.5F, 0, 0.5F, 0});
}

TEST_CASE("unit vectors: weights of bytes sum to 255", "[normals]") {
    Mesh mesh =
        skinned_triangle({0, 1, 2, 0, 0, 1, 0, 0, 0, 1, 0, 0},
                         std::vector<std::uint8_t>{100, 100, 100, 0, 128, 127, 0, 0, 0, 0, 0, 0}, true);
    std::size_t mended = 0;
    static_cast<void>(scale_to_unit(mesh, mended));
    CHECK(mended == 2);
    CHECK(std::get<std::vector<std::uint8_t>>(mesh.attributes[1].data) ==
          std::vector<std::uint8_t>{85, 85, 85, 0, 128, 127, 0, 0, 255, 0, 0, 0});
}

TEST_CASE("unit vectors: values that glTF accepts stay", "[normals]") {
    Mesh mesh = triangle_with({"NORMAL", Domain::wedge, Role::normal, 3, false,
                               std::vector<float>{0, 0, 1.002F, 0, 0, 1, 0, 0, 0.999F}});
    const Mesh before = mesh;
    std::size_t mended = 0;
    static_cast<void>(scale_to_unit(mesh, mended));
    CHECK(mended == 0);
    CHECK(mesh.attributes[0].data == before.attributes[0].data);
}

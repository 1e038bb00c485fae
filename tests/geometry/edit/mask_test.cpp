#include "geometry/edit/mask.hpp"
#include "mesh/shapes.hpp"
#include "support/catch.hpp"
#include "support/failure.hpp"

using namespace facetmill;

TEST_CASE("a mask by material, group and attribute", "[geometry]") {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[0].name = "skin";
    scene.materials[1].name = "hair";
    Part part;
    part.name = "head";
    part.mesh = shapes::grid(2, 1); // faces 0, 1 left, 2, 3 right
    part.mesh.primitives.resize(2);
    part.mesh.primitives[0].material = 0;
    part.mesh.primitives[1].material = 1;
    const std::vector<std::uint32_t> halves{0, 0, 1, 1};
    part.mesh.attributes.push_back({"primitive", Domain::face, Role::index, 1, false, halves});
    part.mesh.attributes.push_back({"group", Domain::face, Role::index, 1, false, halves});
    part.mesh.attributes.push_back(
        {"heat", Domain::vertex, Role::generic, 1, false, std::vector<float>{-1, 0.5F, 2, 0, 1, NAN}});
    using Shares = std::vector<double>;
    CHECK(vertex_mask(part, scene, {}).empty());
    CHECK(vertex_mask(part, scene, {.material = "sk*"}) == Shares{1, 0, 0, 1, 0, 0});
    CHECK(vertex_mask(part, scene, {.group = 1}) == Shares{0, 0, 1, 0, 0, 1});
    CHECK(vertex_mask(part, scene, {.attribute = "heat"}) == Shares{0, 0.5, 1, 0, 1, 0});
    CHECK(vertex_mask(part, scene, {.attribute = "heat", .invert = true}) == Shares{1, 0.5, 0, 1, 0, 1});
    CHECK(vertex_mask(part, scene, {.attribute = "group"}) == Shares{0, 0, 1, 0, 0, 1});
    CHECK(test::failure([&] { vertex_mask(part, scene, {.attribute = "cold"}); }) ==
          "stage [E-MASK] mask: part 'head' has no attribute 'cold' | it has primitive, group, heat");
}

TEST_CASE("hold_caps holds the vertices of faces that a cut numbers", "[geometry]") {
    Mesh mesh = shapes::grid(2, 1); // faces 0, 1 left, 2, 3 right
    std::vector<double> shares;
    hold_caps(mesh, shares);
    CHECK(shares.empty());
    mesh.attributes.push_back(
        {"cut_id", Domain::face, Role::index, 1, false, std::vector<std::uint32_t>{0, 0, 0, 0}});
    hold_caps(mesh, shares);
    CHECK(shares.empty());
    mesh.attributes[0].data = std::vector<std::uint32_t>{0, 0, 3, 3};
    hold_caps(mesh, shares);
    CHECK(shares == std::vector<double>{1, 0, 0, 1, 0, 0});
    shares = {0.5, 0.5, 0.5, 0, 0.5, 0.5};
    hold_caps(mesh, shares);
    CHECK(shares == std::vector<double>{0.5, 0, 0, 0, 0, 0});
}

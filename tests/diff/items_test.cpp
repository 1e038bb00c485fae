#include "support/catch.hpp"

#include "diff/items.hpp"
#include "mesh/shapes.hpp"

using namespace facetmill;
using namespace facetmill::report;

namespace {

Part named_part(const char* name, Mesh mesh) {
    Part part;
    part.name = name;
    part.mesh = std::move(mesh);
    return part;
}

std::string told(const std::vector<ItemChange>& items) {
    std::string text;
    for (const auto& item : items)
        text += std::string(to_string(item.change)) + " " + item.name +
                (item.note.empty() ? "" : ": " + item.note) + "\n";
    return text;
}

} // namespace

TEST_CASE("parts and materials are paired by their names", "[report]") {
    Scene a, b;
    a.parts = {named_part("one", shapes::cube()), named_part("two", shapes::cube()),
               named_part("two", shapes::tetrahedron()), named_part("gone", shapes::cube())};
    b.parts = {named_part("two", shapes::cube()), named_part("new", shapes::cube()),
               named_part("one", shapes::cube())};
    b.parts[0].mesh.positions[0].x += 0.5;
    b.parts[2].mesh.positions[0].x += 1e-9;
    a.materials.resize(2);
    a.materials[0].name = "red";
    a.materials[1].name = "blue";
    b.materials = {a.materials[1]};
    b.materials[0].base_colour[0] = 0.25;
    CHECK(told(item_changes(a, b, 1e-6)) ==
          "same one\nchanged two: moved by up to 0.5\nremoved two\nremoved gone\n"
          "added new\nremoved red\nchanged blue: different colour\n");
    CHECK(item_changes(Scene{}, Scene{}, 0).empty());
}

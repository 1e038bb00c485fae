#include "geometry/edit/primitives.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// [primitives] 1 if faces use the primitive.
std::vector<char> drawn_primitives(const Mesh& mesh) {
    std::vector<char> used(std::max<std::size_t>(mesh.primitives.size(), 1));
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (const Index p = mesh.primitive_of(f); p < used.size()) used[p] = true;
    return used;
}

} // namespace

std::size_t draw_calls(const Mesh& mesh) {
    const auto used = drawn_primitives(mesh);
    return mesh.face_count() == 0 ? 0 : static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
}

bool join_primitives(Mesh& mesh) {
    Attribute* of_face = mesh.find(primitive_attribute, Domain::face);
    if (!of_face || mesh.primitives.size() < 2) return false;
    std::vector<Primitive> table;
    std::vector<std::uint32_t> number;
    for (const Primitive& p : mesh.primitives) {
        const auto same = p.json.empty() ? std::find(table.begin(), table.end(), p) : table.end();
        number.push_back(static_cast<std::uint32_t>(same - table.begin()));
        if (same == table.end()) table.push_back(p);
    }
    if (table.size() == mesh.primitives.size()) return false;
    mesh.primitives = std::move(table);
    for (std::uint32_t& p : std::get<std::vector<std::uint32_t>>(of_face->data))
        if (p < number.size()) p = number[p];
    return true;
}

} // namespace facetmill

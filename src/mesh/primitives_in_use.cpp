#include "mesh/primitives_in_use.hpp"

namespace facetmill {

std::vector<bool> primitives_in_use(const Mesh& mesh) {
    std::vector<bool> used(mesh.primitives.size(), mesh.face_count() == 0 && mesh.lines.empty());
    const auto use = [&](Index p) {
        if (p < used.size()) used[p] = true;
    };
    for (Index f = 0; f < mesh.face_count(); ++f) use(mesh.primitive_of(f));
    for (std::size_t l = 0; l < mesh.line_count(); ++l) use(mesh.primitive_of_line(l));
    return used;
}

} // namespace facetmill

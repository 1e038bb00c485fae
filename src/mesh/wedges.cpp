#include "mesh/wedges.hpp"

#include <numeric>

namespace facetmill {

std::vector<Index> explicit_wedges(const Mesh& mesh) {
    if (mesh.has_seams()) return mesh.wedge_vertex;
    std::vector<Index> wedges(mesh.wedge_count());
    std::iota(wedges.begin(), wedges.end(), Index{0});
    return wedges;
}

std::vector<Index> explicit_offsets(const Mesh& mesh) {
    if (!mesh.face_offsets.empty()) return mesh.face_offsets;
    std::vector<Index> offsets(mesh.face_count() + 1);
    for (std::size_t f = 0; f < offsets.size(); ++f) offsets[f] = static_cast<Index>(3 * f);
    return offsets;
}

} // namespace facetmill

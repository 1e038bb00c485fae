#include "mesh/separate_wedges.hpp"

#include "mesh/wedges.hpp"

#include <map>
#include <numeric>

namespace facetmill {

std::vector<Index> separate_wedges(Mesh& mesh, const std::vector<Index>& class_of_corner) {
    std::vector<Index> class_of(mesh.wedge_count(), none), old(mesh.wedge_count());
    std::iota(old.begin(), old.end(), Index{0});
    std::map<std::pair<Index, Index>, Index> copies;
    for (std::size_t c = 0; c < class_of_corner.size(); ++c) {
        const Index w = mesh.corners[c], own = class_of_corner[c];
        if (class_of[w] == none) class_of[w] = own;
        if (class_of[w] == own) continue;
        const auto [copy, fresh] = copies.try_emplace({w, own}, static_cast<Index>(old.size()));
        if (fresh) {
            old.push_back(w);
            class_of.push_back(own);
        }
        mesh.corners[c] = copy->second;
    }
    if (copies.empty()) return class_of;
    std::vector<Index> vertex = explicit_wedges(mesh);
    for (std::size_t w = vertex.size(); w < old.size(); ++w) vertex.push_back(vertex[old[w]]);
    mesh.wedge_vertex = std::move(vertex);
    for (Attribute& a : mesh.attributes)
        if (a.domain == Domain::wedge) a.select(old);
    return class_of;
}

} // namespace facetmill

#include "geometry/inspect/boundary.hpp"

#include "mesh/power_scale.hpp"

namespace facetmill {

std::vector<BoundaryChain> boundary_chains(const Mesh& mesh) {
    const EdgeTable edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    DisjointSets sets(mesh.vertex_count());
    std::vector<Index> open;
    for (Index e = 0; e < edges.size(); ++e)
        if (edges.corners_of(e).size() == 1)
            open.push_back(e), sets.join(edges.edges[e].low, edges.edges[e].high);
    std::vector<Index> number(mesh.vertex_count(), none); // of the chain, by the root of its set
    std::vector<BoundaryChain> chains;
    const PowerScale scale = even_scale(mesh.bounds());
    for (const Index e : open) { // ascending by lower vertex
        const Vec3 &a = mesh.positions[edges.edges[e].low], &b = mesh.positions[edges.edges[e].high];
        Index& chain = number[sets.find(edges.edges[e].low)];
        if (chain == none) {
            chain = static_cast<Index>(chains.size());
            chains.push_back({0, 0, faces[edges.corners_of(e)[0]], mix(a, b, 0.5)});
        }
        ++chains[chain].edges;
        chains[chain].length += scale.none() ? length(b - a) : length(scale(b) - scale(a));
    }
    for (BoundaryChain& c : chains) c.length = unscaled(c.length, scale.powers[0]);
    return chains;
}

} // namespace facetmill

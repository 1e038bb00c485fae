#include "geometry/split/patterns.hpp"

#include "parallel/storage.hpp"

namespace facetmill::split_detail {

namespace {

void place(std::vector<Vec3>& positions, const Mesh& from, const Provenance& vertices) {
    const std::size_t old = from.vertex_count(), on_edges = vertices.edges.size();
    resize_large(positions, old + on_edges + vertices.mixes());
    parallel_for(old, [&](std::size_t v) { positions[v] = from.positions[v]; });
    parallel_for(on_edges, [&](std::size_t i) {
        const auto& e = vertices.edges[i];
        positions[old + i] = mix(from.positions[e.a], from.positions[e.b], e.t);
    });
    parallel_for(vertices.mixes(), [&](std::size_t i) {
        Vec3 sum;
        for (Index k = vertices.mix_offsets[i]; k < vertices.mix_offsets[i + 1]; ++k)
            sum += from.positions[vertices.mix_sources[k]] * vertices.mix_weights[k];
        positions[old + on_edges + i] = sum;
    });
}

} // namespace

AttributeChanges finish(Mesh& to, const Mesh& from, MeshProvenance& provenance, const EdgePoints* points) {
    Provenance &vertices = provenance.vertices, &wedges = provenance.wedges;
    vertices.identity = wedges.identity = true;
    // Patterns wrote the mixes as wedges, because they work with corners.
    vertices.mix_offsets = wedges.mix_offsets;
    vertices.mix_weights = wedges.mix_weights;
    vertices.mix_sources.resize(wedges.mix_sources.size());
    parallel_for(vertices.mix_sources.size(), [&](std::size_t i) {
        vertices.mix_sources[i] = from.vertex_of_wedge(wedges.mix_sources[i]);
    });
    if (points) points->describe(vertices, wedges);
    place(to.positions, from, vertices);
    if (from.has_seams()) {
        to.wedge_vertex = from.wedge_vertex;
        if (points) points->append_wedge_vertices(to.wedge_vertex);
        const std::size_t inside = to.positions.size() - vertices.mixes();
        for (std::size_t i = 0; i < vertices.mixes(); ++i)
            to.wedge_vertex.push_back(static_cast<Index>(inside + i));
    } else {
        provenance.wedges_as_vertices = true;
    }
    return inherit_attributes(to, from, provenance);
}

} // namespace facetmill::split_detail

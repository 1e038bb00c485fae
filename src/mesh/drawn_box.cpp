#include "mesh/drawn_box.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// [vertices] 1 for the vertices of faces and lines; empty if all vertices are drawn.
std::vector<std::uint8_t> drawn_vertices(const Mesh& mesh) {
    if (mesh.corners.empty() && mesh.lines.empty()) return {};
    std::vector<std::uint8_t> drawn(mesh.vertex_count());
    for (const auto* wedges : {&mesh.corners, &mesh.lines})
        for (const Index w : *wedges) drawn[mesh.vertex_of_wedge(w)] = 1;
    if (std::find(drawn.begin(), drawn.end(), 0) == drawn.end()) drawn.clear();
    return drawn;
}

} // namespace

bool has_unused_vertices(const Mesh& mesh) { return !drawn_vertices(mesh).empty(); }

Box drawn_box(const Mesh& mesh, const Transform& t) {
    const std::vector<std::uint8_t> drawn = drawn_vertices(mesh);
    if (drawn.empty() && t.identity()) return mesh.bounds();
    return parallel_reduce(
        mesh.vertex_count(), Box{},
        [&](std::size_t begin, std::size_t end) {
            Box box;
            for (std::size_t v = begin; v < end; ++v)
                if (drawn.empty() || drawn[v]) box.add(t.point(mesh.positions[v]));
            return box;
        },
        [](Box a, const Box& b) {
            a.add(b);
            return a;
        });
}

} // namespace facetmill

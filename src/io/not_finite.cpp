#include "io/not_finite.hpp"

#include "geometry/edit/surgery.hpp"
#include "mesh/invariants.hpp"

#include <algorithm>

namespace facetmill::io {

namespace {

std::vector<std::uint8_t> not_finite_vertices(const Mesh& mesh) {
    std::vector<std::uint8_t> flags(mesh.vertex_count(), 0);
    for (Index v = 0; v < flags.size(); ++v) flags[v] = !is_finite(mesh.positions[v]);
    return flags;
}

std::size_t drop_lines(Mesh& mesh, const std::vector<std::uint8_t>& bad) {
    std::size_t kept = 0;
    const std::size_t lines = mesh.line_count();
    for (std::size_t l = 0; l < lines; ++l) {
        if (bad[mesh.vertex_of_wedge(mesh.lines[2 * l])] || bad[mesh.vertex_of_wedge(mesh.lines[2 * l + 1])])
            continue;
        mesh.lines[2 * kept] = mesh.lines[2 * l];
        mesh.lines[2 * kept + 1] = mesh.lines[2 * l + 1];
        if (!mesh.line_primitive.empty()) mesh.line_primitive[kept] = mesh.line_primitive[l];
        ++kept;
    }
    mesh.lines.resize(2 * kept);
    if (!mesh.line_primitive.empty()) mesh.line_primitive.resize(kept);
    return lines - kept;
}

std::size_t drop_faces(Mesh& mesh, const std::vector<std::uint8_t>& bad) {
    std::vector<std::uint8_t> flags(mesh.face_count(), 0);
    for (Index f = 0; f < flags.size(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) flags[f] |= bad[mesh.vertex(c)];
    const auto dropped = static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
    if (dropped > 0) mesh = keep_faces(mesh, faces_without(flags));
    return dropped;
}

} // namespace

NotFinite drop_not_finite(Part& part) {
    Mesh& mesh = part.mesh;
    const std::size_t vertices = mesh.vertex_count();
    NotFinite dropped;
    dropped.first = first_not_finite(mesh.positions);
    if (dropped.first == vertices) return {};
    const auto bad = not_finite_vertices(mesh);
    dropped.vertices = static_cast<std::size_t>(std::count(bad.begin(), bad.end(), 1));
    dropped.lines = drop_lines(mesh, bad);
    dropped.faces = drop_faces(mesh, bad);
    drop_unused(mesh, not_finite_vertices(mesh));
    part.changed = true;
    return dropped;
}

} // namespace facetmill::io

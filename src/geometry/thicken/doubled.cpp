#include "geometry/thicken/doubled.hpp"

#include "mesh/topology.hpp"

namespace facetmill {

namespace {

std::vector<Index> spelled_wedges(const Mesh& mesh) {
    if (mesh.has_seams()) return mesh.wedge_vertex;
    std::vector<Index> wedges(mesh.wedge_count());
    for (Index w = 0; w < wedges.size(); ++w) wedges[w] = w;
    return wedges;
}

} // namespace

Doubled doubled(const Mesh& mesh, const std::vector<Index>& back_vertex,
                const std::vector<Index>& back_copies) {
    Doubled d;
    const auto wedges = spelled_wedges(mesh);
    const auto count = static_cast<Index>(wedges.size());
    d.mesh.positions = mesh.positions;
    for (const Index v : back_copies) d.mesh.positions.push_back(mesh.positions[v]);
    d.mesh.wedge_vertex = wedges;
    for (const Index v : wedges) d.mesh.wedge_vertex.push_back(back_vertex[v]);
    d.mesh.corners = mesh.corners;
    d.mesh.face_offsets = mesh.face_offsets;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
        d.mesh.corners.push_back(count + mesh.corners[begin]);
        for (Index c = end - 1; c > begin; --c) d.mesh.corners.push_back(count + mesh.corners[c]);
        if (!mesh.all_triangles()) d.mesh.face_offsets.push_back(static_cast<Index>(d.mesh.corners.size()));
    }
    for (int side = 0; side < 2; ++side) {
        for (Index w = 0; w < count; ++w) d.descent.wedges.copies.push_back(w);
        for (Index f = 0; f < mesh.face_count(); ++f) d.descent.faces.push_back(f);
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) d.descent.vertices.copies.push_back(v);
    d.descent.vertices.copies.insert(d.descent.vertices.copies.end(), back_copies.begin(), back_copies.end());
    return d;
}

void turn_wedges(Mesh& mesh, std::size_t first, AttributeChanges& changes) {
    for (auto& a : mesh.attributes) {
        if (a.domain != Domain::wedge || !(a.role == Role::normal || a.role == Role::tangent)) continue;
        for (std::size_t w = first; w < a.size(); ++w) {
            if (a.role == Role::normal)
                for (int c = 0; c < a.components; ++c) a.set_value(w, c, -a.value(w, c));
            else if (a.components == 4)
                a.set_value(w, 3, -a.value(w, 3));
        }
        for (auto& f : changes)
            if (f.attribute == a.name && f.domain == a.domain)
                f = {a.name, a.domain, AttributeChange::Kind::recomputed, "reversed on the back"};
    }
}

std::vector<OpenEdge> open_edges(const Mesh& mesh) {
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<OpenEdge> open;
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        const Index e = edges.corner_edge[c];
        if (e != none && edges.corners_of(e).size() == 1)
            open.push_back({c, next_corner(mesh, faces[c], c), faces[c]});
    }
    return open;
}

} // namespace facetmill

#include "geometry/thicken/doubled.hpp"

#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "mesh/wedges.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace facetmill {

Doubled doubled(const Mesh& mesh, const std::vector<Index>& back_vertex,
                const std::vector<Index>& back_copies) {
    Doubled d;
    const auto wedges = explicit_wedges(mesh);
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
        for (Index w = 0; w < count; ++w) d.provenance.wedges.copies.push_back(w);
        for (Index f = 0; f < mesh.face_count(); ++f) d.provenance.faces.push_back(f);
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) d.provenance.vertices.copies.push_back(v);
    d.provenance.vertices.copies.insert(d.provenance.vertices.copies.end(), back_copies.begin(),
                                        back_copies.end());
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

namespace {

/// Returns boundary_edges, sorted by corner.
std::vector<BoundaryEdge> boundary_by_corner(const Mesh& mesh) {
    auto edges = boundary_edges(mesh);
    std::sort(edges.begin(), edges.end(),
              [](const BoundaryEdge& a, const BoundaryEdge& b) { return a.corner < b.corner; });
    return edges;
}

} // namespace

std::size_t add_walls(const Mesh& mesh, Doubled& d, WedgeNormals& normals) {
    const bool own = mesh.find("NORMAL", Domain::wedge) != nullptr;
    const auto back = static_cast<Index>(mesh.wedge_count());
    std::size_t added = 0;
    for (const BoundaryEdge& e : boundary_by_corner(mesh)) {
        const Index u = mesh.corners[e.corner], v = mesh.corners[next_corner(mesh, e.face, e.corner)];
        std::array<Index, 4> ring{v, u, back + u, back + v};
        if (own) {
            const auto at = [&](std::size_t i) { return d.mesh.positions[d.mesh.vertex_of_wedge(ring[i])]; };
            const Vec3 normal = normalised(cross(at(2) - at(0), at(3) - at(1)));
            for (Index& w : ring) {
                d.provenance.wedges.copies.push_back(w % back);
                d.mesh.wedge_vertex.push_back(d.mesh.wedge_vertex[w]);
                w = static_cast<Index>(d.mesh.wedge_vertex.size() - 1);
                normals.emplace_back(w, normal);
            }
        }
        const auto add = [&](std::span<const Index> wedges) {
            add_face(d.mesh, wedges);
            d.provenance.faces.push_back(e.face);
            ++added;
        };
        const auto same = [&](std::size_t i, std::size_t j) {
            return d.mesh.vertex_of_wedge(ring[i]) == d.mesh.vertex_of_wedge(ring[j]);
        };
        const bool at_u = same(1, 2), at_v = same(0, 3), below = same(2, 3);
        if (!at_u && !at_v && !below && !mesh.all_triangles()) {
            add(ring);
            continue;
        }
        if (!at_u) add(std::array{ring[0], ring[1], ring[2]});
        if (!at_v && !below) add(std::array{ring[0], ring[2], ring[3]});
    }
    return added;
}

void set_normals(Mesh& mesh, const WedgeNormals& normals) {
    Attribute* of_mesh = mesh.find("NORMAL", Domain::wedge);
    if (!of_mesh) return;
    for (const auto& [w, normal] : normals)
        for (int c = 0; c < 3; ++c) of_mesh->set_value(w, c, normal[static_cast<std::size_t>(c)]);
}

} // namespace facetmill

#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

namespace {

/// The wedges of a vertex that had the same normal, and the sum of the area vectors of their faces.
struct NormalGroup {
    Vec3 old, sum;
};

Vec3 normal_of(const Attribute& a, Index w) { return {a.value(w, 0), a.value(w, 1), a.value(w, 2)}; }

/// Gives the wedges of the corners at a vertex their new normals.
void renew_at_vertex(const Mesh& mesh, std::span<const Index> corners, const std::vector<Index>& face_of,
                     const std::vector<Vec3>& areas, const Attribute& old, Attribute& renewed,
                     std::vector<NormalGroup>& groups) {
    groups.clear();
    const auto group_of = [&](Index c) -> NormalGroup& {
        const Vec3 normal = normal_of(old, mesh.corners[c]);
        for (auto& g : groups)
            if (g.old == normal) return g;
        return groups.emplace_back(NormalGroup{normal, {}});
    };
    for (const Index c : corners) group_of(c).sum += areas[face_of[c]];
    for (const Index c : corners) {
        const Vec3 normal = normalised(group_of(c).sum);
        if (!(dot(normal, normal) > 0)) continue; // if all faces have no area, the old normal stays
        for (int i = 0; i < 3; ++i)
            renewed.set_value(mesh.corners[c], i, normal[static_cast<std::size_t>(i)]);
    }
}

} // namespace

std::optional<AttributeChange> recompute_normals(Mesh& mesh) {
    Attribute* normals = mesh.find("NORMAL", Domain::wedge);
    if (!normals || normals->components != 3) return {};
    std::vector<Vec3> areas(mesh.face_count());
    parallel_for(areas.size(), [&](std::size_t f) { areas[f] = area_vector(mesh, static_cast<Index>(f)); });
    const auto face_of = corner_faces(mesh);
    const auto corners_at = corners_at_vertices(mesh);
    const Attribute old = *normals;
    parallel_chunks(mesh.vertex_count(), [&](std::size_t begin, std::size_t end) {
        std::vector<NormalGroup> groups;
        for (std::size_t v = begin; v < end; ++v)
            renew_at_vertex(mesh, corners_at.of(static_cast<Index>(v)), face_of, areas, old, *normals,
                            groups);
    });
    return AttributeChange{"NORMAL", Domain::wedge, AttributeChange::Kind::recomputed,
                           "area-weighted over the faces at each vertex"};
}

} // namespace facetmill

#include "geometry/simplify/prepared.hpp"

namespace facetmill::simplification {

Prepared::Prepared(const Mesh& given, const SimplifySettings& settings) {
    if (given.has_seams() && given.find("NORMAL", Domain::wedge)) {
        seams = merge_normal_seams(own.emplace(given), settings.crease);
        if (seams.merged == 0) own.reset();
    }
    if (!given.all_triangles()) own = triangulated(own ? *own : given);
}

void settle_normals(Mesh& mesh, const NormalSeams& seams, Fates& fates) {
    using Shading = NormalSeams::Shading;
    if (seams.shading == Shading::as_given) return;
    if (seams.shading == Shading::faceted) set_facet_normals(mesh);
    for (Fate& fate : fates) {
        if (fate.domain != Domain::wedge) continue;
        if (fate.attribute == "NORMAL")
            fate = {
                fate.attribute, fate.domain, Fate::Kind::recomputed,
                seams.shading == Shading::faceted
                    ? "flat shading: the normals of the new faces"
                    : "area-weighted where seams below the crease angle were merged, interpolated elsewhere"};
        else if (fate.attribute == "TANGENT")
            fate = {fate.attribute, fate.domain, Fate::Kind::interpolated,
                    "one of each merged normal seam, mixed at new elements"};
    }
}

SimplifyLocks by_used_vertices(SimplifyLocks lock, Mesh& mesh) {
    if (lock.vertices.empty()) return lock;
    std::vector<std::uint8_t> used(mesh.vertex_count()), locked;
    for (Index c = 0; c < mesh.corner_count(); ++c) used[mesh.vertex(c)] = 1;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) locked.push_back(lock.vertices[v]);
    drop_unused(mesh);
    lock.vertices = std::move(locked);
    return lock;
}

} // namespace facetmill::simplification

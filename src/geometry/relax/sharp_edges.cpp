#include "geometry/relax/sharp_edges.hpp"

#include "base/parallel.hpp"
#include "base/portable_math.hpp"
#include "mesh/face.hpp"

#include <algorithm>

namespace facetmill {

VertexLists sharp_ends(const Mesh& mesh, double angle, const Transform& to_world, bool boundaries) {
    const EdgeTable table = build_edges(mesh);
    const std::vector<Index> faces = corner_faces(mesh);
    const double limit = cosine(angle);
    std::vector<std::uint8_t> sharp(table.size());
    parallel_for(table.size(), [&](std::size_t e) {
        const auto at = table.corners_of(static_cast<Index>(e));
        if (at.size() != 2) {
            sharp[e] = boundaries || at.size() > 2;
            return;
        }
        const Vec3 a = normalised(area_vector(mesh, faces[at[0]], to_world)),
                   b = normalised(area_vector(mesh, faces[at[1]], to_world));
        const bool agree = mesh.vertex(at[0]) != mesh.vertex(at[1]);
        if (a == Vec3{} || b == Vec3{}) return;
        sharp[e] = exceeds_feature_angle(agree ? dot(a, b) : -dot(a, b), limit);
    });
    VertexLists lists;
    lists.offsets.assign(mesh.vertex_count() + 1, 0);
    for (std::size_t e = 0; e < sharp.size(); ++e)
        if (sharp[e]) {
            ++lists.offsets[table.edges[e].low];
            ++lists.offsets[table.edges[e].high];
        }
    lists.items.resize(exclusive_scan(lists.offsets));
    std::vector<Index> at(lists.offsets.begin(), lists.offsets.end());
    for (std::size_t e = 0; e < sharp.size(); ++e) {
        if (!sharp[e]) continue;
        const auto& [low, high] = table.edges[e];
        lists.items[at[low]++] = high;
        lists.items[at[high]++] = low;
    }
    parallel_for(mesh.vertex_count(), [&](std::size_t v) {
        std::sort(lists.items.begin() + lists.offsets[v], lists.items.begin() + lists.offsets[v + 1]);
    });
    return lists;
}

} // namespace facetmill

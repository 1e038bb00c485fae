#include "io/why_lost.hpp"

#include "mesh/placement.hpp"

#include <algorithm>
#include <array>

namespace facetmill::io {

namespace {

using Points = std::vector<std::array<double, 3>>;

void add_used(const Part& part, bool in_world_space, Points& points) {
    const Mesh& mesh = part.mesh;
    std::vector<std::uint8_t> used(mesh.vertex_count());
    for (Index c = 0; c < mesh.corner_count(); ++c) used[mesh.vertex(c)] = 1;
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (!used[v]) continue;
        const Vec3 p = in_world_space ? in_world(part, mesh.positions[v]) : mesh.positions[v];
        points.push_back({p.x, p.y, p.z});
    }
}

std::size_t count_places(Points& points) {
    std::sort(points.begin(), points.end());
    return static_cast<std::size_t>(std::unique(points.begin(), points.end()) - points.begin());
}

void add(VertexChanges& sum, Points before, Points after) {
    const std::size_t were = before.size(), are = after.size();
    const std::size_t places = count_places(before), left = count_places(after);
    const std::size_t rounded = places > left ? places - left : 0;
    sum.rounded += rounded;
    if (are > were) sum.added += are - were;
    if (were > are + rounded) sum.merged += were - are - rounded;
}

} // namespace

VertexChanges vertex_changes(const Scene& before, const Scene& after) {
    VertexChanges changes;
    const bool by_part = before.parts.size() == after.parts.size();
    Points here, there;
    for (std::size_t i = 0; i < before.parts.size(); ++i) {
        add_used(before.parts[i], !by_part, here);
        if (!by_part) continue;
        add_used(after.parts[i], false, there);
        add(changes, std::move(here), std::move(there));
        here = {}, there = {};
    }
    if (by_part) return changes;
    for (const Part& part : after.parts) add_used(part, true, there);
    add(changes, std::move(here), std::move(there));
    return changes;
}

} // namespace facetmill::io

#include "mesh/cut_memory.hpp"

#include <algorithm>

namespace facetmill {

namespace {

bool before(const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

} // namespace

bool CutMemory::Entry::has(const Vec3& point, double side_of_it) const {
    return std::fabs(side_of_it) <= reach && std::binary_search(points.begin(), points.end(), point, before);
}

const CutMemory::Entry* CutMemory::find(const Plane& plane) const {
    const auto at = std::find_if(entries.begin(), entries.end(),
                                 [&](const Entry& e) { return same_plane(e.plane, plane); });
    return at == entries.end() ? nullptr : &*at;
}

void CutMemory::add(const Plane& plane, std::vector<Vec3> points) {
    // Sides are measured against the plane as it was written first.
    const Entry* known = find(plane);
    Entry fresh{known ? known->plane : plane, known ? known->reach : 0, {}};
    std::erase_if(points, [&](const Vec3& p) {
        const double s = std::fabs(side(fresh.plane, p));
        fresh.reach = std::max(fresh.reach, s);
        return s == 0;
    });
    if (known) points.insert(points.end(), known->points.begin(), known->points.end());
    std::sort(points.begin(), points.end(), before);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    fresh.points = std::move(points);
    if (known)
        entries[static_cast<std::size_t>(known - entries.data())] = std::move(fresh);
    else
        entries.push_back(std::move(fresh));
}

} // namespace facetmill

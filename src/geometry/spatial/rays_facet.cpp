// The note's cases of one segment and one facet, of geometry/spatial/rays.hpp.
#include "base/predicates.hpp"
#include "geometry/polygon/polygon.hpp"
#include "geometry/spatial/rays.hpp"

namespace facetmill {

const char* to_string(Meeting meeting) {
    constexpr const char* names[] = {"hit", "parallel", "in plane", "outside segment", "outside facet"};
    return names[static_cast<std::size_t>(meeting)];
}

SegmentFacet meet(const Line& line, std::span<const Vec3> facet) {
    SegmentFacet result;
    std::size_t second = 1, third = 2;
    while (third < facet.size() && collinear(facet[0], facet[second], facet[third])) {
        if (facet[0] == facet[second]) second = third;
        ++third;
    }
    if (third >= facet.size()) return result; // no plane
    const Vec3 &a = facet[0], &b = facet[second], &c = facet[third];
    const Vec3 n = cross(b - a, c - a), d = line.to - line.from;
    const int from = orientation_3d(a, b, c, line.from), to = orientation_3d(a, b, c, line.to);
    const double along = dot(n, d);
    if (from == 0 && to == 0) {
        result.meeting = Meeting::in_plane;
        return result;
    }
    if (along == 0 || line.from == line.to) return result;
    result.t = from == 0 ? 0 : to == 0 ? 1 : dot(n, a - line.from) / along;
    result.point = line.from + d * result.t;
    const bool crosses = line.ray ? from == 0 || (along > 0) == (from < 0) : from * to <= 0;
    if (!crosses) {
        result.meeting = Meeting::outside_segment;
        return result;
    }
    // Seen along the axis nearest to the normal, with the point where the line meets the plane.
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(n[i]) > std::abs(n[axis])) axis = i;
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<Vec2> ring;
    for (const Vec3& p : facet) ring.push_back({p[u], p[v]});
    const auto place = polygon::locate({result.point[u], result.point[v]}, ring);
    result.meeting = place == polygon::Place::outside ? Meeting::outside_facet : Meeting::hit;
    return result;
}

} // namespace facetmill

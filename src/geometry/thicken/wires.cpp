#include "base/portable_math.hpp"
#include "base/parallel.hpp"
#include "geometry/thicken/thicken.hpp"
#include "mesh/inverse.hpp"
#include "mesh/topology.hpp"

#include <array>

namespace facetmill {

namespace {

/// Two directions that make a right-handed frame with the unit vector w.
std::array<Vec3, 2> across(const Vec3& w) {
    const double x = std::abs(w.x), y = std::abs(w.y), z = std::abs(w.z);
    const Vec3 other = x <= y && x <= z ? Vec3{1, 0, 0} : y <= z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 u = normalised(cross(other, w));
    return {u, cross(w, u)};
}

} // namespace

WiresResult wires(const Mesh& mesh, const WiresSettings& s) {
    const auto table = build_edges(mesh);
    std::vector<EdgeTable::Edge> lines;
    WiresResult r;
    for (Index e = 0; e < table.size(); ++e) {
        if (s.open_only && table.corners_of(e).size() != 1) continue;
        const auto& edge = table.edges[e];
        if (length(mesh.positions[edge.high] - mesh.positions[edge.low]) > 0)
            lines.push_back(edge);
        else
            ++r.skipped;
    }
    r.edges = lines.size();
    const auto n = static_cast<Index>(s.sides);
    const Index points = 2 * n, corners = 4 * n + 2 * n; // quads around, a polygon at each end
    r.mesh.positions.resize(lines.size() * points);
    r.mesh.corners.resize(lines.size() * corners);
    r.mesh.face_offsets.resize(lines.size() * (n + 2) + 1);
    struct Direction {
        double x, y;
    };
    std::vector<Direction> ring(n);
    for (Index i = 0; i < n; ++i) ring[i] = {cosine(2 * pi * i / n), sine(2 * pi * i / n)};
    const Transform back = inverse(s.to_world).value_or(Transform{});
    const double front = s.to_world.determinant() < 0 ? -1 : 1; // a mirrored part keeps its front
    parallel_for(lines.size(), [&](std::size_t l) {
        const Vec3 a = s.to_world.point(mesh.positions[lines[l].low]),
                   b = s.to_world.point(mesh.positions[lines[l].high]);
        const auto [u, v] = across(normalised(b - a));
        const auto first = static_cast<Index>(l * points);
        Index* corner = r.mesh.corners.data() + l * corners;
        Index offset = static_cast<Index>(l * corners);
        Index* offsets = r.mesh.face_offsets.data() + l * (n + 2);
        for (Index i = 0; i < n; ++i) {
            const Vec3 aside = (u * (ring[i].x * front) + v * ring[i].y) * (s.thickness / 2);
            r.mesh.positions[first + i] = back.point(a + aside);
            r.mesh.positions[first + n + i] = back.point(b + aside);
            const Index j = (i + 1) % n;
            *offsets++ = offset;
            offset += 4;
            for (const Index k : {i, j, n + j, n + i}) *corner++ = first + k;
        }
        *offsets++ = offset;
        offset += n;
        for (Index i = n; i-- > 0;) *corner++ = first + i;
        *offsets++ = offset;
        for (Index i = 0; i < n; ++i) *corner++ = first + n + i;
    });
    r.mesh.face_offsets.back() = static_cast<Index>(r.mesh.corners.size());
    return r;
}

} // namespace facetmill

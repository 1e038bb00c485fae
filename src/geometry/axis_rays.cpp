#include "geometry/axis_rays.hpp"

#include "base/parallel.hpp"
#include "base/predicates.hpp"

namespace facetmill {

namespace {

/// How often the triangle's outline winds around p in the plane of the axes j and k, by the crossings of its
/// edges with the half line from p along j: edges count from their low end on, and p on an edge counts as
/// right of it.
int winding(const std::array<Vec3, 3>& t, const Vec3& p, std::size_t j, std::size_t k) {
    int turns = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = t[i], &b = t[(i + 1) % 3];
        if ((a[k] <= p[k]) == (b[k] <= p[k])) continue;
        const int side = orientation_2d(a[j], a[k], b[j], b[k], p[j], p[k]);
        if (a[k] <= p[k] && side > 0) ++turns;
        if (b[k] <= p[k] && side < 0) --turns;
    }
    return turns;
}

} // namespace

AxisRays::AxisRays(const Mesh& mesh) {
    Mesh cut;
    const Mesh* from = &mesh;
    if (!mesh.all_triangles()) {
        cut.positions = mesh.positions, cut.wedge_vertex = mesh.wedge_vertex;
        cut.corners = mesh.corners, cut.face_offsets = mesh.face_offsets;
        std::vector<std::uint32_t> faces(mesh.face_count());
        for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<std::uint32_t>(f);
        cut.attributes = {{"parent", Domain::face, Role::index, 1, false, std::move(faces)}};
        cut = triangulated(cut);
        parent_ = std::get<std::vector<std::uint32_t>>(std::move(cut.attributes[0].data));
        from = &cut;
    }
    triangles_.resize(from->face_count());
    std::vector<Box> boxes(triangles_.size());
    parallel_for(triangles_.size(), [&](std::size_t t) {
        bool finite = true;
        for (std::size_t i = 0; i < 3; ++i) {
            triangles_[t][i] = from->point(static_cast<Index>(3 * t + i));
            finite = finite && is_finite(triangles_[t][i]);
        }
        if (finite)
            for (const Vec3& p : triangles_[t]) boxes[t].add(p);
    });
    tree_ = BoxTree(std::move(boxes));
}

int AxisRays::crossing(Index triangle, const Vec3& p, std::size_t axis, bool forward) const {
    const auto& t = triangles_[triangle];
    const int turns = winding(t, p, (axis + 1) % 3, (axis + 2) % 3);
    if (turns == 0) return 0;
    // Seen against the axis the triangle turns `turns` times: its normal looks along the axis when that is 1,
    // and then it lies ahead of p when p is behind it.
    const int ahead = -turns * orientation_3d(t[0], t[1], t[2], p);
    return forward ? (ahead > 0 ? turns : 0) : (ahead < 0 ? -turns : 0);
}

} // namespace facetmill

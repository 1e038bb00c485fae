#include "geometry/remesh/anchor.hpp"

#include "geometry/transfer/transfer.hpp"

namespace facetmill::remeshing {

namespace {

std::vector<Index> ends_of_features(const WorkingMesh& m) {
    std::vector<Index> ends;
    for (Index h = 0; h < m.corners.size(); ++h)
        if (m.stands(h) && m.flags[h] & feature && !(m.flags[h] & locked))
            ends.insert(ends.end(), {m.from(h), m.to(h)});
    return ends;
}

/// The lines as triangles without area.
Surface surface_of_lines(const WorkingMesh& m, const std::vector<Index>& ends) {
    Surface lines;
    lines.positions.reserve(ends.size());
    lines.corners.reserve(ends.size() / 2 * 3);
    for (Index i = 0; i < ends.size(); i += 2) {
        lines.positions.insert(lines.positions.end(), {m.points[ends[i]], m.points[ends[i + 1]]});
        lines.corners.insert(lines.corners.end(), {i, i + 1, i + 1});
    }
    return lines;
}

bool are_equal(const std::vector<double>& sizes) {
    return std::all_of(sizes.begin(), sizes.end(), [&](double s) { return s == sizes.front(); });
}

} // namespace

Anchor::Anchor(const Mesh& input, const FaceTree& tree, const WorkingMesh& start)
    : input_(input), tree_(tree), sizes_(start.sizes),
      size_(!sizes_.empty() && are_equal(sizes_) ? sizes_.front() : 0), ends_(ends_of_features(start)),
      lines_(surface_of_lines(start, ends_), FaceTree::Use::near) {}

std::optional<Spot> Anchor::on_surface(const Vec3& p, Index hint) const {
    const Closest found = closest_point(tree_, p, hint);
    if (found.face == none) return {};
    const FaceTree::Triangle t = tree_.triangle(found.triangle);
    Spot spot{found.point, size_, found.triangle, cross(t.b - t.a, t.c - t.a)};
    if (size_ > 0) return spot;
    const std::array<double, 3> w = barycentric_weights(t, found.point);
    for (Index k = 0; k < 3; ++k) spot.size += w[k] * sizes_[input_.vertex(3 * found.face + k)];
    return spot;
}

std::optional<Spot> Anchor::on_lines(const Vec3& p) const {
    if (lines_.empty()) return {};
    const Closest found = closest_point(lines_, p);
    if (found.face == none) return {};
    Spot spot{found.point, size_, none, {}};
    if (size_ > 0) return spot;
    const FaceTree::Triangle t = lines_.triangle(found.triangle);
    const double whole = length(t.b - t.a), share = whole > 0 ? length(found.point - t.a) / whole : 0;
    const std::size_t i = 2 * std::size_t{found.face};
    spot.size = sizes_[ends_[i]] * (1 - share) + sizes_[ends_[i + 1]] * share;
    return spot;
}

} // namespace facetmill::remeshing

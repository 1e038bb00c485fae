#include "geometry/spatial/triangle_slabs.hpp"

namespace facetmill {

namespace {

Float4 dot(const Float4x3& a, const Float4x3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Float4x3 cross(const Float4x3& a, const Float4x3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Float4 size(const Float4& x) { return greater(x, -x); }

} // namespace

// Rounding errors, for coordinates below 2 and edges below 7: a position along a vector is accurate to
// `rounding` times its length. A normal is accurate to 5 / 2^24 times the product of the edges: per
// component, two roundings of edges, one of products and one of differences. If the normal is longer than 3
// / 16 of this product and of the longest edge, its error is below twice `rounding` at the ends of the
// edges. The foot is accurate to twice `rounding`, for which `reach` leaves a margin, and the height to 4
// times.
TriangleSlabs::TriangleSlabs(const std::array<Float4x3, 3>& corners, const std::array<Float4x3, 3>& edges,
                             float square)
    : normal_(cross(edges[0], edges[1])), offset_(dot(normal_, corners[0])) {
    const Float4 squares[] = {dot(edges[0], edges[0]), dot(edges[1], edges[1]), dot(edges[2], edges[2])};
    const Float4 longest = greater(greater(squares[0], squares[1]), squares[2]), area = dot(normal_, normal_);
    const Float4 limit = area * (square * (1 - 1e-5F));
    Float4 farthest{};
    for (const Float4x3& corner : corners)
        for (const Float4& x : corner) farthest = greater(farthest, size(x));
    const Int4 is_good = (farthest < Float4{} + 2) & (limit > Float4{} + 1e-36F) &
                         (area > longest * squares[0] * squares[1] * (9.0F / 256));
    square_ = is_good ? limit : Float4{} - 1;
    for (std::size_t i = 0; i < 3; ++i) {
        out_[i] = cross(edges[i], normal_);
        const Float4 room = (size(out_[i][0]) + size(out_[i][1]) + size(out_[i][2])) * (2 * rounding);
        reach_[i] = dot(out_[i], corners[i]) - room;
    }
}

} // namespace facetmill

#pragma once
// Compares faces around an edge by exact predicates.

#include "base/math/predicates.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <vector>

namespace facetmill {

/// A point in the half plane, bounded by the line of the edge, in which the face continues from the edge at
/// corner c. For a triangle, it is the third vertex.
[[nodiscard]] inline Vec3 beside_edge(const Mesh& mesh, Index f, Index c) {
    const Index next = next_corner(mesh, f, c);
    if (mesh.face_size(f) == 3) return mesh.point(next_corner(mesh, f, next));
    return mesh.point(c) + cross(normalised(area_vector(mesh, f)), mesh.point(next) - mesh.point(c));
}

/// Whether p is on q's side of the line u v, exactly. p must be in the plane of u, v and q.
inline bool on_same_side(const Vec3& u, const Vec3& v, const Vec3& q, const Vec3& p) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t x = (i + 1) % 3, y = (i + 2) % 3;
        const int side = orientation_2d(u[x], u[y], v[x], v[y], q[x], q[y]);
        if (side != 0) return side == orientation_2d(u[x], u[y], v[x], v[y], p[x], p[y]);
    }
    return true;
}

/// A face at an edge: its corner along the edge, a point off the edge, and its direction along it.
struct EdgeLeaf {
    Index corner;
    Vec3 beside;
    bool forward; ///< from the edge's low vertex to its high vertex
    int half = 0; ///< 0: in the half plane of the first leaf, 2: opposite, 1 and 3: between them, in order
};

/// Sorts the leaves exactly by their angle from the first leaf around the edge from u to v. Ties are sorted
/// by corner.
inline void sort_around_edge(const Vec3& u, const Vec3& v, std::vector<EdgeLeaf>& leaves) {
    const Vec3 start = leaves[0].beside;
    for (EdgeLeaf& l : leaves) {
        const int side = orientation_3d(u, v, start, l.beside);
        l.half = side > 0 ? 1 : side < 0 ? 3 : on_same_side(u, v, start, l.beside) ? 0 : 2;
    }
    std::sort(leaves.begin(), leaves.end(), [&](const EdgeLeaf& a, const EdgeLeaf& b) {
        if (a.half != b.half) return a.half < b.half;
        const int side = a.half % 2 == 0 ? 0 : orientation_3d(u, v, a.beside, b.beside);
        return side != 0 ? side > 0 : a.corner < b.corner;
    });
}

} // namespace facetmill

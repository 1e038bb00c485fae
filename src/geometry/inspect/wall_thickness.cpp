#include "geometry/inspect/wall_thickness.hpp"

#include "base/parallel.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/surface.hpp"
#include "mesh/surface_normal.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Where the ray from p along d leaves through the triangle's front; negative when it does not (Moeller,
/// Trumbore 1997).
double leaves_at(const Vec3& p, const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a, n = cross(u, v);
    const double facing = dot(n, d);
    if (!(facing > 0)) return -1;
    const Vec3 w = p - a, q = cross(w, d);
    const double s = -dot(v, q), t = dot(u, q); // barycentric, times facing
    if (!(s >= 0 && t >= 0 && s + t <= facing)) return -1;
    return -dot(n, w) / facing;
}

} // namespace

std::vector<double> wall_thickness(const Mesh& mesh) {
    const Surface surface = surface_of(mesh);
    std::vector<Box> boxes(surface.size());
    parallel_for(boxes.size(), [&](std::size_t t) {
        for (std::size_t i = 0; i < 3; ++i)
            if (is_finite(surface.point(t, i))) boxes[t].add(surface.point(t, i));
    });
    const BoxTree tree(boxes);
    const double all = surface.bounds().diagonal();
    std::vector<double> ways(mesh.face_count(), HUGE_VAL);
    parallel_for(
        ways.size(),
        [&](std::size_t f) {
            const auto face = static_cast<Index>(f);
            const Vec3 d = -normalised(area_vector(mesh, face));
            if (!(dot(d, d) > 0) || !(all < HUGE_VAL)) return;
            Vec3 p;
            for (Index c = mesh.face_begin(face); c < mesh.face_end(face); ++c) p += mesh.point(c);
            p = p / mesh.face_size(face);
            // Pieces of the ray, each as long as all before: boxes stay small as long as the wall is thin.
            for (double from = 0, to = all / 1024; from <= all && ways[f] > from; from = to, to *= 2) {
                Box piece;
                piece.add(p + d * from), piece.add(p + d * to);
                tree.visit(piece, [&](Index t) {
                    if (surface.face(t) == face) return;
                    const double at =
                        leaves_at(p, d, surface.point(t, 0), surface.point(t, 1), surface.point(t, 2));
                    if (at >= 0) ways[f] = std::min(ways[f], at);
                });
            }
        },
        256);
    return ways;
}

} // namespace facetmill

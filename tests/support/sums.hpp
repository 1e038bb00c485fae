#pragma once
// Volumes and areas with hardly any rounding, so that tests measure the cut and not the summation.

#include "mesh/mesh.hpp"

#include <cmath>

namespace facetmill::test {

/// The sum of a term over the fan triangles of the faces.
template <class Term>
long double sum_over(const Mesh& mesh, Term&& term) {
    long double sum = 0;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f) + 1; c + 1 < mesh.face_end(f); ++c)
            sum += term(mesh.point(mesh.face_begin(f)), mesh.point(c), mesh.point(c + 1));
    return sum;
}

inline long double volume_about(const Mesh& mesh, const Vec3& origin) {
    return sum_over(mesh,
                    [&](const Vec3& a, const Vec3& b, const Vec3& c) -> long double {
                        const auto minus = [&](const Vec3& p, std::size_t i) {
                            return static_cast<long double>(p[i]) - origin[i];
                        };
                        const auto term = [&](std::size_t i, std::size_t j, std::size_t k) {
                            return minus(a, i) * (minus(b, j) * minus(c, k) - minus(b, k) * minus(c, j));
                        };
                        return term(0, 1, 2) + term(1, 2, 0) + term(2, 0, 1);
                    }) /
           6;
}

/// The area of the faces that like(face) selects, by fans: for triangles and convex faces.
template <class Like>
long double area_where(const Mesh& mesh, Like&& like) {
    long double sum = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (!like(f)) continue;
        for (Index c = mesh.face_begin(f) + 1; c + 1 < mesh.face_end(f); ++c) {
            const auto edge = [&](Index to, std::size_t i) {
                return static_cast<long double>(mesh.point(to)[i]) - mesh.point(mesh.face_begin(f))[i];
            };
            long double squares = 0;
            for (std::size_t i = 0, j = 1; i < 3; ++i, j = (i + 1) % 3) {
                const long double n = edge(c, i) * edge(c + 1, j) - edge(c, j) * edge(c + 1, i);
                squares += n * n;
            }
            sum += std::sqrt(squares) / 2;
        }
    }
    return sum;
}

} // namespace facetmill::test

#include "mesh/transform.hpp"

#include <cmath>

namespace facetmill {

std::optional<Transform> inverse(const Transform& t) {
    const double d = t.determinant();
    if (d == 0 || !std::isfinite(d)) return std::nullopt;
    const Vec3 rows[3] = {{t.m[0][0], t.m[0][1], t.m[0][2]},
                          {t.m[1][0], t.m[1][1], t.m[1][2]},
                          {t.m[2][0], t.m[2][1], t.m[2][2]}};
    Transform r;
    for (std::size_t j = 0; j < 3; ++j) {
        const Vec3 column = cross(rows[(j + 1) % 3], rows[(j + 2) % 3]) / d;
        for (std::size_t i = 0; i < 3; ++i) r.m[i][j] = column[i];
    }
    const Vec3 move = -r.vector({t.m[0][3], t.m[1][3], t.m[2][3]});
    for (std::size_t i = 0; i < 3; ++i) r.m[i][3] = move[i];
    return r;
}

} // namespace facetmill

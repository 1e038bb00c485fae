#include "geometry/plane.hpp"

#include "base/error.hpp"

namespace facetmill {

namespace {

/// A sum of doubles kept without rounding, as an expansion: components of growing magnitude that do not
/// overlap.
class ExactSum {
  public:
    void add(double b) {
        int kept = 0;
        for (int i = 0; i < size_; ++i) {
            const double sum = b + parts_[i], virtual_b = sum - b;
            const double error = (b - (sum - virtual_b)) + (parts_[i] - virtual_b);
            if (error != 0) parts_[kept++] = error;
            b = sum;
        }
        if (b != 0) parts_[kept++] = b;
        size_ = kept;
    }
    void add_product(double a, double b) {
        const double product = a * b;
        const auto [a_high, a_low] = halves(a);
        const auto [b_high, b_low] = halves(b);
        const double error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
        add(error);
        add(product);
    }
    /// The value, rounded; its sign is the sign of the largest component, which is the last.
    double value() const {
        double sum = 0;
        for (int i = 0; i < size_; ++i) sum += parts_[i];
        return sum;
    }

  private:
    struct Halves {
        double high, low;
    };
    static Halves halves(double a) {
        const double c = 134217729.0 * a; // 2^27 + 1
        const double high = c - (c - a);
        return {high, a - high};
    }
    double parts_[16];
    int size_ = 0;
};

double exact_side(const Plane& plane, const Vec3& p) {
    ExactSum sum;
    for (std::size_t i = 0; i < 3; ++i) {
        sum.add_product(plane.normal[i], p[i]);
        sum.add_product(plane.normal[i], -plane.through[i]);
    }
    sum.add(plane.offset);
    return sum.value();
}

} // namespace

double side(const Plane& plane, const Vec3& p) {
    const double x = plane.normal.x * (p.x - plane.through.x), y = plane.normal.y * (p.y - plane.through.y),
                 z = plane.normal.z * (p.z - plane.through.z);
    const double value = x + y + z + plane.offset;
    const double magnitude = std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(plane.offset);
    // Each term carries at most two roundings and goes through at most three sums: 5 * 2^-53, taken as 8 *
    // 2^-53 so that the roundings of this bound itself do not matter. The smallest normal number covers
    // underflow.
    if (std::fabs(value) > 8.9e-16 * magnitude + 1e-300) return value;
    if (magnitude == 0 && (p == plane.through || axis_of(plane) >= 0)) return 0;
    return exact_side(plane, p);
}

Plane pulled_back(const Plane& plane, const Transform& to_world) {
    if (to_world.identity()) return plane;
    const auto& m = to_world.m;
    const Vec3 shift{m[0][3], m[1][3], m[2][3]};
    Plane local{to_world.pull_normal(plane.normal), {}, plane.offset};
    const double det = to_world.determinant();
    const Vec3 q = plane.through - shift;
    const Vec3 rows[3] = {
        {m[0][0], m[0][1], m[0][2]}, {m[1][0], m[1][1], m[1][2]}, {m[2][0], m[2][1], m[2][2]}};
    const bool diagonal = rows[0].y == 0 && rows[0].z == 0 && rows[1].x == 0 && rows[1].z == 0 &&
                          rows[2].x == 0 && rows[2].y == 0;
    if (diagonal && det != 0) {
        local.through = {q.x / rows[0].x, q.y / rows[1].y, q.z / rows[2].z};
    } else if (det != 0 && std::isfinite(1 / det)) {
        local.through =
            (cross(rows[1], rows[2]) * q.x + cross(rows[2], rows[0]) * q.y + cross(rows[0], rows[1]) * q.z) /
            det;
    } else {
        local.offset += dot(plane.normal, shift - plane.through);
    }
    return local;
}

int axis_of(const Plane& plane) {
    int axis = -1, count = 0;
    for (int i = 0; i < 3; ++i)
        if (plane.normal[static_cast<std::size_t>(i)] != 0) axis = i, ++count;
    return count == 1 ? axis : -1;
}

void check_plane(const Plane& plane) {
    if (plane.normal == Vec3{} || !is_finite(plane.normal))
        throw Error(ErrorKind::usage, "E-PLANE", "the plane's normal must be finite and not zero",
                    "for example normal: [0, 0, 1]");
    if (!is_finite(plane.through) || !std::isfinite(plane.offset))
        throw Error(ErrorKind::usage, "E-PLANE", "the plane's point and offset must be finite numbers");
}

} // namespace facetmill

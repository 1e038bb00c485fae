#include "mesh/plane.hpp"

#include "base/error.hpp"
#include "base/math/exact_integer.hpp"
#include "base/math/exact_sum.hpp"

namespace facetmill {

namespace {

/// Computes the side for numbers whose products doubles cannot hold.
double whole_side(const Plane& plane, const Vec3& p) {
    mpz_class sum = exact_integer(plane.offset) << 1074;
    for (std::size_t i = 0; i < 3; ++i)
        sum += exact_integer(plane.normal[i]) * (exact_integer(p[i]) - exact_integer(plane.through[i]));
    return rounded(sum, 2 * 1074);
}

double exact_side(const Plane& plane, const Vec3& p) {
    ExactSum<13> sum;
    for (std::size_t i = 0; i < 3; ++i) {
        sum.add_product(plane.normal[i], p[i]);
        sum.add_product(plane.normal[i], -plane.through[i]);
    }
    sum.add(plane.offset);
    return sum.holds() ? sum.value() : whole_side(plane, p);
}

} // namespace

double side(const Plane& plane, const Vec3& p) {
    const double x = plane.normal.x * (p.x - plane.through.x), y = plane.normal.y * (p.y - plane.through.y),
                 z = plane.normal.z * (p.z - plane.through.z);
    const double value = x + y + z + plane.offset;
    const double magnitude = std::fabs(x) + std::fabs(y) + std::fabs(z) + std::fabs(plane.offset);
    // Each term has at most two roundings and passes at most three sums: 5 * 2^-53. The bound uses 8 *
    // 2^-53, so that its own rounding does not matter. The smallest normal number covers underflow.
    if (std::fabs(value) > 8.9e-16 * magnitude + 1e-300) return value;
    if (magnitude == 0) {
        const int axis = axis_of(plane);
        const auto i = static_cast<std::size_t>(axis);
        if (axis < 0 ? p == plane.through : p[i] == plane.through[i]) return 0;
    }
    return exact_side(plane, p);
}

namespace {

/// Whether components i and j of the normals are certainly not proportional. Each product and the difference
/// have a single rounding.
bool surely_turned(const Vec3& a, const Vec3& b, std::size_t i, std::size_t j) {
    const double x = a[i] * b[j], y = a[j] * b[i];
    return std::fabs(x - y) > 4.5e-16 * (std::fabs(x) + std::fabs(y)) + 1e-300;
}

/// Returns the same plane, scaled by a power of two to a normal with length near 1, so that products with it
/// do not overflow.
Plane scaled(Plane plane) {
    int power = -2000;
    for (std::size_t i = 0; i < 3; ++i)
        if (plane.normal[i] != 0) power = std::max(power, std::ilogb(plane.normal[i]));
    for (std::size_t i = 0; i < 3; ++i) plane.normal[i] = std::ldexp(plane.normal[i], -power);
    plane.offset = std::ldexp(plane.offset, -power);
    return plane;
}

} // namespace

bool same_plane(const Plane& given_a, const Plane& given_b) {
    if (given_a == given_b) return true;
    for (std::size_t i = 0; i < 3; ++i)
        if (surely_turned(given_a.normal, given_b.normal, i, (i + 1) % 3)) return false;
    const Plane a = scaled(given_a), b = scaled(given_b);
    for (std::size_t i = 0; i < 3; ++i) {
        ExactSum<4> turn; // turn between the normals
        turn.add_product(a.normal[i], b.normal[(i + 1) % 3]);
        turn.add_product(-a.normal[(i + 1) % 3], b.normal[i]);
        if (turn.sign() != 0) return false;
    }
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::fabs(a.normal[i]) > std::fabs(a.normal[axis])) axis = i;
    const auto level = [](const Plane& p) { // the value of normal . x for points x in the plane
        ExactSum<7> sum;
        for (std::size_t i = 0; i < 3; ++i) sum.add_product(p.normal[i], p.through[i]);
        sum.add(-p.offset);
        return sum;
    };
    ExactSum<> difference;
    difference.add_scaled(level(a), b.normal[axis]);
    difference.add_scaled(level(b), -a.normal[axis]);
    return difference.sign() == 0;
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
        if (plane.normal[static_cast<std::size_t>(i)] != 0) {
            axis = i;
            ++count;
        }
    return count == 1 ? axis : -1;
}

void check_plane(const Plane& plane) {
    if (plane.normal == Vec3{} || !is_finite(plane.normal))
        throw Error(ErrorKind::usage, "E-PLANE", "the plane's normal must be finite and not zero",
                    "give a direction: plane: {normal: [0, 0, 1]}");
    if (!is_finite(plane.through) || !std::isfinite(plane.offset))
        throw Error(ErrorKind::usage, "E-PLANE", "the plane's point and offset must be finite numbers");
}

} // namespace facetmill

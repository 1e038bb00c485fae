#pragma once
// Vectors of three doubles, and the operations that every algorithm needs. All use + - x / sqrt only, so
// results do not depend on the processor (see base/math/portable_math.hpp for transcendental functions).

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace facetmill {

/// A point or a direction, in scene units unless the context says otherwise.
struct Vec3 {
    double x = 0, y = 0, z = 0;

    constexpr double operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
    constexpr double& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
    constexpr bool operator==(const Vec3&) const = default;
    constexpr Vec3& operator+=(const Vec3& b) {
        x += b.x;
        y += b.y;
        z += b.z;
        return *this;
    }
    constexpr Vec3& operator-=(const Vec3& b) {
        x -= b.x;
        y -= b.y;
        z -= b.z;
        return *this;
    }
    constexpr Vec3& operator*=(double s) {
        x *= s;
        y *= s;
        z *= s;
        return *this;
    }
};

constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) { return a *= s; }
constexpr Vec3 operator*(double s, Vec3 a) { return a *= s; }
constexpr Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }

[[nodiscard]] constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// a scaled to unit length; the zero vector stays zero.
[[nodiscard]] inline Vec3 normalised(const Vec3& a) {
    const double l = length(a);
    return l > 0 ? a / l : a;
}

/// The point at parameter t between a (t = 0, exactly a) and b (t = 1, exactly b).
[[nodiscard]] constexpr Vec3 mix(const Vec3& a, const Vec3& b, double t) { return a * (1 - t) + b * t; }

inline bool is_finite(const Vec3& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// An axis-aligned box; empty until a point is added.
struct Box {
    Vec3 min{HUGE_VAL, HUGE_VAL, HUGE_VAL}, max{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    void add(const Vec3& p) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (p[i] < min[i]) min[i] = p[i];
            if (p[i] > max[i]) max[i] = p[i];
        }
    }
    void add(const Box& b) {
        if (!b.empty()) {
            add(b.min);
            add(b.max);
        }
    }
    Vec3 centre() const { return (min + max) * 0.5; }
    Vec3 extent() const { return empty() ? Vec3{} : max - min; }
    /// The longest side; 0 when empty.
    double longest_side() const {
        const Vec3 e = extent();
        return std::max({e.x, e.y, e.z});
    }
    /// The length of the space diagonal; 0 when empty.
    double diagonal() const { return length(extent()); }
};

/// An affine map, row-major: maps p to m*p, with p as a column (x, y, z, 1).
struct Transform {
    double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

    bool operator==(const Transform&) const = default;
    bool identity() const { return *this == Transform{}; }
    Vec3 point(const Vec3& p) const { return vector(p) + Vec3{m[0][3], m[1][3], m[2][3]}; }
    Vec3 vector(const Vec3& v) const {
        return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
                m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
    }
    /// The plane normal n (n.p = const) before the map: the transpose of the linear part times n.
    Vec3 pull_normal(const Vec3& n) const {
        return {m[0][0] * n.x + m[1][0] * n.y + m[2][0] * n.z, m[0][1] * n.x + m[1][1] * n.y + m[2][1] * n.z,
                m[0][2] * n.x + m[1][2] * n.y + m[2][2] * n.z};
    }
    double determinant() const {
        return dot({m[0][0], m[0][1], m[0][2]},
                   cross({m[1][0], m[1][1], m[1][2]}, {m[2][0], m[2][1], m[2][2]}));
    }
};

/// The transform that applies b, then a.
inline Transform operator*(const Transform& a, const Transform& b) {
    Transform r;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) {
            r.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
            if (j == 3) r.m[i][j] += a.m[i][3];
        }
    return r;
}

} // namespace facetmill

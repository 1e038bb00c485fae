#include "base/predicates.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace facetmill {

namespace {

int sign_of(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// A sum of doubles that do not overlap, smallest first, so that the sign of the last is the sign of all.
struct Expansion {
    std::array<double, 12> parts{};
    int size = 0;

    /// Adds x exactly (Shewchuk's grow-expansion, zeros left out).
    void add(double x) {
        int kept = 0;
        for (int i = 0; i < size; ++i) {
            const double part = parts[static_cast<std::size_t>(i)], sum = x + part, virtual_part = sum - x;
            const double rest = (x - (sum - virtual_part)) + (part - virtual_part);
            if (rest != 0) parts[static_cast<std::size_t>(kept++)] = rest;
            x = sum;
        }
        if (x != 0 || kept == 0) parts[static_cast<std::size_t>(kept++)] = x;
        size = kept;
    }
    /// Adds a * b exactly; std::fma is exact on every processor.
    void add_product(double a, double b) {
        const double product = a * b;
        add(std::fma(a, b, -product));
        add(product);
    }
    int sign() const { return size == 0 ? 0 : sign_of(parts[static_cast<std::size_t>(size - 1)]); }
};

/// A power of two that brings the largest of the numbers near 1, so that products neither overflow nor
/// vanish.
double scale_for(std::initializer_list<double> numbers) {
    double most = 0;
    for (const double x : numbers) most = std::max(most, std::abs(x));
    return most > 0 && std::isfinite(most) ? std::ldexp(1.0, std::clamp(-std::ilogb(most), -1000, 1000)) : 1;
}

} // namespace

int orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) {
    const double left = (ax - cx) * (by - cy), right = (ay - cy) * (bx - cx), det = left - right;
    if (std::abs(det) > orientation_error * (std::abs(left) + std::abs(right)) &&
        std::abs(det) > orientation_smallest)
        return sign_of(det);
    const double sx = scale_for({ax, bx, cx}), sy = scale_for({ay, by, cy});
    ax *= sx, bx *= sx, cx *= sx, ay *= sy, by *= sy, cy *= sy;
    Expansion exact; // (a-c) x (b-c), multiplied out
    exact.add_product(ax, by);
    exact.add_product(-ax, cy);
    exact.add_product(-cx, by);
    exact.add_product(-ay, bx);
    exact.add_product(ay, cx);
    exact.add_product(cy, bx);
    return exact.sign();
}

bool collinear(const Vec3& a, const Vec3& b, const Vec3& c) {
    return orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y) == 0 &&
           orientation_2d(a.y, a.z, b.y, b.z, c.y, c.z) == 0 &&
           orientation_2d(a.z, a.x, b.z, b.x, c.z, c.x) == 0;
}

} // namespace facetmill

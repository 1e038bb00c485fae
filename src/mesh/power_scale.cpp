#include "mesh/power_scale.hpp"

#include "mesh/placement.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace facetmill {

namespace {

/// The power of two below the side of a box; none for a side without length.
std::optional<int> side_power(const Box& box, std::size_t axis) {
    const double side = box.empty() ? 0 : box.max[axis] - box.min[axis];
    if (std::isfinite(side)) return side > 0 ? std::optional(std::ilogb(side)) : std::nullopt;
    const double half = box.max[axis] * 0.5 - box.min[axis] * 0.5;
    return std::isfinite(half) ? std::optional(std::ilogb(half) + 1) : std::nullopt;
}

/// Powers of sides that need no scaling.
constexpr int room = 100;

} // namespace

Vec3 PowerScale::operator()(const Vec3& p) const {
    return {std::ldexp(p.x, powers[0]), std::ldexp(p.y, powers[1]), std::ldexp(p.z, powers[2])};
}

std::vector<Vec3> PowerScale::operator()(const std::vector<Vec3>& points) const {
    std::vector<Vec3> scaled(points.size());
    parallel_for(points.size(), [&](std::size_t i) { scaled[i] = (*this)(points[i]); });
    return scaled;
}

Mesh PowerScale::operator()(const Mesh& mesh) const {
    Mesh scaled = bare(mesh);
    for (Vec3& p : scaled.positions) p = (*this)(p);
    return scaled;
}

PowerScale even_scale(const Box& box) {
    std::optional<int> most;
    for (std::size_t i = 0; i < 3; ++i)
        if (const auto power = side_power(box, i)) most = most ? std::max(*most, *power) : *power;
    return most && std::abs(*most) > room ? PowerScale{{-*most, -*most, -*most}} : PowerScale{};
}

PowerScale axis_scale(const Box& box) {
    PowerScale scale;
    bool far = false;
    for (std::size_t i = 0; i < 3; ++i)
        if (const auto power = side_power(box, i)) {
            scale.powers[i] = -*power;
            far = far || std::abs(*power) > room;
        }
    return far ? scale : PowerScale{};
}

double unscaled(double x, int power) { return std::ldexp(x, -power); }

double scaled_length(const Vec3& v) {
    const double most = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(most > 0 && std::isfinite(most))) return length(v);
    const int power = -std::ilogb(most);
    return unscaled(length(PowerScale{{power, power, power}}(v)), power);
}

double diagonal(const Box& box) {
    const PowerScale scale = even_scale(box);
    if (scale.none()) return box.diagonal();
    return unscaled(length(scale(box.max) - scale(box.min)), scale.powers[0]);
}

} // namespace facetmill

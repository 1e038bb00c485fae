#include "geometry/crumple/crumple.hpp"

#include "base/math/inverse_normals.hpp"
#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "base/math/random.hpp"

#include <algorithm>
#include <bit>

namespace facetmill {

namespace {

std::uint32_t canonical_bits(double x) {
    const float f = static_cast<float>(x);
    return f == 0 ? 0 : std::bit_cast<std::uint32_t>(f);
}

/// Rounds to 40 significant bits (a double has 53), so that positions that differ by the rounding of a
/// transform mostly coincide. -0 becomes 0.
double as_far_place(double x) {
    constexpr int left_out = 53 - 40;
    const std::uint64_t half = std::uint64_t{1} << (left_out - 1);
    const double rounded =
        std::bit_cast<double>((std::bit_cast<std::uint64_t>(x) + half) & ~(2 * half - 1)); // may carry up
    return rounded == 0 ? 0 : rounded;
}

/// The lattice cell of a coordinate, and the smooth weight (0 to 1) of its upper end.
struct NoiseCell {
    std::int64_t low;
    double weight;
};
NoiseCell cell_of(double x) {
    constexpr double most = 4503599627370496.0; // 2^52; beyond this, no two points share a cell anyway
    const double low = std::floor(std::clamp(x, -most, most)), t = std::clamp(x - low, 0.0, 1.0);
    return {static_cast<std::int64_t>(low), t * t * t * (t * (t * 6 - 15) + 10)};
}

double octave(std::uint64_t seed, const Vec3& p, double truncate) {
    const NoiseCell cells[3] = {cell_of(p.x), cell_of(p.y), cell_of(p.z)};
    double sum = 0, squares = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::uint64_t key = seed;
        for (int axis = 0; axis < 3; ++axis) {
            const bool up = (corner >> axis) & 1;
            weight *= up ? cells[axis].weight : 1 - cells[axis].weight;
            key = hashed(key, static_cast<std::uint64_t>(cells[axis].low + up));
        }
        if (weight == 0) continue;
        sum += weight * gaussian(key, truncate);
        squares += weight * weight;
    }
    return sum / std::sqrt(squares);
}

} // namespace

double gaussian(std::uint64_t key, double truncate) {
    double g = 0;
    for (std::uint64_t attempt = 0; attempt < 4096; ++attempt) {
        g = inverse_normal(uniform(hashed(key, attempt)));
        if (g >= -truncate && g <= truncate) return g;
    }
    return std::clamp(
        g, -truncate,
        truncate); // practically unreachable: even at truncate 0.1, a draw succeeds with probability 0.08
}

void gaussians(std::span<const std::uint64_t> keys, double truncate, std::span<double> all) {
    for (std::size_t i = 0; i < keys.size(); ++i) all[i] = uniform(hashed(keys[i], 0));
    inverse_normals(all, all);
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (!(all[i] >= -truncate && all[i] <= truncate)) all[i] = gaussian(keys[i], truncate);
}

std::uint64_t noise_key(std::uint64_t seed, const Vec3& world, PositionRounding rounding) {
    std::uint64_t key = hashed(seed, 0x6372756d706c65);
    if (rounding == PositionRounding::far) {
        for (std::size_t i = 0; i < 3; ++i)
            key = hashed(key, std::bit_cast<std::uint64_t>(as_far_place(world[i])));
        return key;
    }
    const std::uint64_t xy = (std::uint64_t{canonical_bits(world.x)} << 32) | canonical_bits(world.y);
    return hashed(hashed(key, xy), canonical_bits(world.z));
}

double CorrelatedNoise::at(std::uint64_t seed, const Vec3& world) const {
    Vec3 p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = (places == PositionRounding::far ? as_far_place(world[i]) : as_float32(world[i])) * frequency;
    double sum = 0, squares = 0, amount = 1;
    for (int k = 0; k < octaves; ++k) {
        sum += amount * octave(hashed(seed, 0x6f637461 + static_cast<std::uint64_t>(k)), p, truncate);
        squares += amount * amount;
        amount *= roughness;
        p *= 2;
    }
    return std::clamp(sum / std::sqrt(squares), -truncate, truncate);
}

} // namespace facetmill

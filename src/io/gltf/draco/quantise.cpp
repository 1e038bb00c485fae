#include "io/gltf/draco/quantise.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace facetmill::io {

namespace {

constexpr double decimals = 1e6; ///< precision of std::to_string

/// The number after the library stores it as text.
float by_text(float x) { return std::strtof(std::to_string(x).c_str(), nullptr); }

/// The nearest storable number in a direction; x itself if it is storable.
float storable(float x, double direction) {
    if (by_text(x) == x) return x;
    const double begin = static_cast<double>(x) * decimals;
    for (double n = direction < 0 ? std::floor(begin) : std::ceil(begin);; n += direction) {
        const float next = by_text(static_cast<float>(n / decimals));
        if ((next - x) * direction >= 0 && by_text(next) == next) return next;
    }
}

/// Whether both ways of rounding give the same step. std::fma is exact on every processor.
bool is_settled(float difference, float density) {
    const float product = difference * density;
    return std::floor(product + 0.5F) == std::floor(std::fma(difference, density, 0.5F));
}

bool is_settled(double scaled, double centre) {
    const double product = scaled * centre;
    return std::floor(product + 0.5) == std::floor(std::fma(scaled, centre, 0.5));
}

/// Replaces the normal by the integer vector on the octahedron |x| + |y| + |z| = centre that it rounds to.
void put_on_octahedron(float* normal, const double* scaled, double centre) {
    double a = std::floor(scaled[0] * centre + 0.5), b = std::floor(scaled[1] * centre + 0.5);
    double c = centre - std::abs(a) - std::abs(b);
    if (c < 0) {
        b += b > 0 ? c : -c;
        c = 0;
    }
    normal[0] = static_cast<float>(a);
    normal[1] = static_cast<float>(b);
    normal[2] = static_cast<float>(scaled[2] < 0 ? -c : c);
}

} // namespace

float DracoGrid::density() const { return static_cast<float>((std::int64_t{1} << bits) - 1) / range; }

float storable_below(float x) { return storable(x, -1); }

float storable_above(float x) { return storable(std::max(x, static_cast<float>(1 / decimals)), 1); }

int bits_as_fine(int bits, float range, float storable) {
    constexpr double finer = 1.25;
    const auto steps = [](int b) { return std::ldexp(1.0, b) - 1; };
    const double most = finer * range / steps(bits);
    while (bits < 30 && range > 0 && storable / steps(bits) > most) ++bits;
    return bits;
}

DracoGrid grid_of(const std::vector<float>& numbers, int components, int bits) {
    const auto width = static_cast<std::size_t>(components);
    DracoGrid grid{std::vector<float>(width, 0.0F), 1, bits};
    if (numbers.empty()) return grid;
    std::copy_n(numbers.begin(), width, grid.origin.begin());
    std::vector<float> most = grid.origin;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        grid.origin[i % width] = std::min(grid.origin[i % width], numbers[i]);
        most[i % width] = std::max(most[i % width], numbers[i]);
    }
    float given = 0, range = 0;
    for (std::size_t c = 0; c < width; ++c) {
        given = std::max(given, most[c] - grid.origin[c]);
        grid.origin[c] = storable_below(grid.origin[c]);
        range = std::max(range, most[c] - grid.origin[c]);
    }
    if (!(given > 0)) range = std::max(range, 1.0F);
    grid.range = storable_above(range);
    grid.bits = bits_as_fine(bits, given, grid.range);
    return grid;
}

float settled(float x, float origin, float density) {
    constexpr int farthest = 64; // beyond this, the grid is finer than the numbers
    float up = x, down = x;
    for (int n = 0; n < farthest; ++n) {
        if (is_settled(up - origin, density)) return up;
        up = std::nextafter(up, HUGE_VALF);
        down = std::nextafter(down, -HUGE_VALF);
        if (is_settled(down - origin, density)) return down;
    }
    return x;
}

std::uint32_t step_of(float x, float origin, float density) {
    const float product = (x - origin) * density;
    return static_cast<std::uint32_t>(std::max(0.0F, std::floor(product + 0.5F)));
}

void put_on_grid(std::vector<float>& decoded, const DracoGrid& grid) {
    const float density = grid.density(),
                step = grid.range / static_cast<float>((std::int64_t{1} << grid.bits) - 1);
    const std::size_t width = grid.origin.size();
    parallel_for(decoded.size(), [&](std::size_t i) {
        const float origin = grid.origin[i % width];
        const float along = static_cast<float>(step_of(decoded[i], origin, density)) * step;
        decoded[i] = along + origin;
    });
}

void settle(std::vector<float>& numbers, const DracoGrid& grid) {
    const float density = grid.density();
    const std::size_t width = grid.origin.size();
    parallel_for(numbers.size(),
                 [&](std::size_t i) { numbers[i] = settled(numbers[i], grid.origin[i % width], density); });
}

void settle_normals(std::vector<float>& normals, int bits) {
    const double centre = static_cast<double>(((std::int64_t{1} << bits) - 2) / 2);
    parallel_for(normals.size() / 3, [&](std::size_t i) {
        float* n = &normals[3 * i];
        double sum = 0;
        for (int c = 0; c < 3; ++c) sum += std::abs(static_cast<double>(n[c]));
        if (!(sum > 1e-6)) return; // Draco's limit; Draco makes shorter vectors point along x
        const double scale = 1.0 / sum;
        const double scaled[3] = {n[0] * scale, n[1] * scale, n[2] * scale};
        if (!is_settled(scaled[0], centre) || !is_settled(scaled[1], centre))
            put_on_octahedron(n, scaled, centre);
    });
}

} // namespace facetmill::io

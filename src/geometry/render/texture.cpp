#include "geometry/render/texture.hpp"

#include "base/math/whole_number.hpp"
#include "geometry/render/srgb.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

using Level = TextureImage::Level;

/// The pixels of `large` that pixel i of `small` covers, with their weights.
struct Cover {
    std::size_t first = 0, count = 0;
    std::array<float, 3> weights{}; ///< a level is at most half as large, so three cover all
};

Cover covered_by(int i, int small, int large) {
    // In units of 1 / small of a large pixel, all are integers.
    const std::int64_t from = std::int64_t{i} * large, to = from + large;
    Cover cover;
    cover.first = static_cast<std::size_t>(from / small);
    for (std::int64_t at = static_cast<std::int64_t>(cover.first); at * small < to; ++at) {
        const std::int64_t part = std::min(to, (at + 1) * small) - std::max(from, at * small);
        cover.weights[cover.count++] = static_cast<float>(part) / static_cast<float>(large);
    }
    return cover;
}

Texel decoded(const std::uint8_t* p, bool srgb) {
    Texel t{};
    for (std::size_t c = 0; c < 3; ++c) t[c] = srgb ? linear_of(p[c]) : static_cast<float>(p[c]) / 255;
    t[3] = static_cast<float>(p[3]) / 255;
    return t;
}

std::uint8_t byte_of(float x) {
    return static_cast<std::uint8_t>(std::floor(std::clamp(x, 0.0f, 1.0f) * 255 + 0.5f));
}

void mean_of(const Level& large, const Cover& across, const Cover& down, bool srgb, std::uint8_t* to) {
    Texel plain{}, weighted{};
    for (std::size_t j = 0; j < down.count; ++j)
        for (std::size_t i = 0; i < across.count; ++i) {
            const std::size_t at =
                (down.first + j) * static_cast<std::size_t>(large.width) + across.first + i;
            const Texel t = decoded(&large.rgba[4 * at], srgb);
            const float w = down.weights[j] * across.weights[i];
            for (std::size_t c = 0; c < 4; ++c) plain[c] += w * t[c];
            for (std::size_t c = 0; c < 3; ++c) weighted[c] += w * t[3] * t[c];
        }
    for (std::size_t c = 0; c < 3; ++c) {
        const float x = plain[3] > 0 ? weighted[c] / plain[3] : plain[c];
        to[c] = srgb ? srgb_of(x) : byte_of(x);
    }
    to[3] = byte_of(plain[3]);
}

Level halved(const Level& large, bool srgb) {
    Level small{std::max(1, large.width / 2), std::max(1, large.height / 2), {}};
    const auto width = static_cast<std::size_t>(small.width), height = static_cast<std::size_t>(small.height);
    small.rgba.resize(4 * width * height);
    parallel_for(
        height,
        [&](std::size_t y) {
            const Cover down = covered_by(static_cast<int>(y), small.height, large.height);
            for (std::size_t x = 0; x < width; ++x)
                mean_of(large, covered_by(static_cast<int>(x), small.width, large.width), down, srgb,
                        &small.rgba[4 * (y * width + x)]);
        },
        64);
    return small;
}

/// Maps a pixel coordinate into [0, size).
int wrapped(double x, int size, TextureWrap wrap) {
    if (wrap == TextureWrap::clamp) return std::clamp(whole_number<int>(x), 0, size - 1);
    const double period = wrap == TextureWrap::mirror ? 2.0 * size : size;
    const double inside = x - std::floor(x / period) * period;
    const int i = whole_number<int>(std::clamp<double>(inside, 0, period - 1));
    return i < size ? i : 2 * size - 1 - i;
}

} // namespace

std::size_t TextureImage::bytes() const {
    std::size_t sum = 0;
    for (const Level& level : levels) sum += level.rgba.size();
    return sum;
}

std::size_t texture_bytes(std::size_t width, std::size_t height, std::size_t max_side) {
    std::size_t sum = 0;
    while (width > 1 || height > 1) {
        if (std::max(width, height) <= max_side) sum += 4 * width * height;
        width = std::max<std::size_t>(1, width / 2);
        height = std::max<std::size_t>(1, height / 2);
    }
    return sum + 4;
}

std::shared_ptr<const TextureImage> texture_image(int width, int height, std::vector<std::uint8_t> rgba,
                                                  bool srgb, int max_side) {
    auto image = std::make_shared<TextureImage>();
    image->srgb = srgb;
    Level level{width, height, std::move(rgba)};
    while (level.width > 1 || level.height > 1) {
        Level next = halved(level, srgb);
        if (std::max(level.width, level.height) <= max_side) image->levels.push_back(std::move(level));
        level = std::move(next);
    }
    image->levels.push_back(std::move(level));
    return image;
}

namespace {

/// Samples a level at (u, v) after the transform.
void add_bilinear(const Texture& t, const Level& level, double u, double v, float weight, bool nearest,
                  Texel& sum) {
    const double x = u * level.width - (nearest ? 0 : 0.5), y = v * level.height - (nearest ? 0 : 0.5);
    const double left = std::floor(x), top = std::floor(y);
    const auto right_part = static_cast<float>(nearest ? 0 : x - left);
    const auto lower_part = static_cast<float>(nearest ? 0 : y - top);
    for (std::size_t k = 0; k < (nearest ? 1U : 4U); ++k) {
        const bool right = k & 1, lower = k & 2;
        const float w =
            weight * (right ? right_part : 1 - right_part) * (lower ? lower_part : 1 - lower_part);
        const int px = wrapped(left + right, level.width, t.wrap_u);
        const int py = wrapped(top + lower, level.height, t.wrap_v);
        const std::size_t at = static_cast<std::size_t>(py) * static_cast<std::size_t>(level.width) +
                               static_cast<std::size_t>(px);
        const Texel c = decoded(&level.rgba[4 * at], t.image->srgb);
        for (std::size_t i = 0; i < 4; ++i) sum[i] += w * c[i];
    }
}

/// The footprint in pixels of the largest level.
struct Axes {
    double long_u, long_v; ///< the longer axis in texture coordinates
    double longer, shorter;
};

Axes footprint_axes(const Texture& t, const TextureFootprint& f) {
    const auto& m = t.transform;
    const double ux = m[0] * f.du_dx + m[1] * f.dv_dx, vx = m[3] * f.du_dx + m[4] * f.dv_dx;
    const double uy = m[0] * f.du_dy + m[1] * f.dv_dy, vy = m[3] * f.du_dy + m[4] * f.dv_dy;
    const Level& full = t.image->levels.front();
    const auto size = [&](double u, double v) {
        const double x = u * full.width, y = v * full.height;
        return std::sqrt(x * x + y * y);
    };
    const double right = size(ux, vx), down = size(uy, vy);
    if (!(right < 1e9 && down < 1e9)) return {0, 0, 1e9, 1e9};
    return right >= down ? Axes{ux, vx, right, down} : Axes{uy, vy, down, right};
}

/// An approximation of log2 of x >= 1, linear between powers of two, which is accurate enough to mix levels.
double mip_level(double x) {
    int exponent = 0;
    const double mantissa = std::frexp(x, &exponent); // the mantissa is from 0.5 to 1
    return exponent - 1 + (2 * mantissa - 1);
}

} // namespace

Texel Texture::sampled(double u, double v, const TextureFootprint& footprint) const {
    const double tu = transform[0] * u + transform[1] * v + transform[2];
    const double tv = transform[3] * u + transform[4] * v + transform[5];
    const double s = std::isfinite(tu) ? tu : 0, t = std::isfinite(tv) ? tv : 0;
    Texel sum{};
    const Axes axes = footprint_axes(*this, footprint);
    if (axes.longer <= 1) {
        add_bilinear(*this, image->levels.front(), s, t, 1, nearest, sum);
        return sum;
    }
    constexpr double most = 8;
    const int places = static_cast<int>(std::ceil(std::min(most, axes.longer / std::max(axes.shorter, 1.0))));
    const double level = mip_level(std::max(1.0, axes.longer / places));
    const std::size_t last = image->levels.size() - 1;
    const std::size_t low = std::min(static_cast<std::size_t>(level), last), high = std::min(low + 1, last);
    const auto part = static_cast<float>(std::clamp(level - static_cast<double>(low), 0.0, 1.0));
    for (int i = 0; i < places; ++i) {
        const double along = (i + 0.5) / places - 0.5;
        const double pu = s + along * axes.long_u, pv = t + along * axes.long_v;
        const float weight = 1.0f / static_cast<float>(places);
        add_bilinear(*this, image->levels[low], pu, pv, weight * (1 - part), false, sum);
        if (part > 0) add_bilinear(*this, image->levels[high], pu, pv, weight * part, false, sum);
    }
    return sum;
}

} // namespace facetmill

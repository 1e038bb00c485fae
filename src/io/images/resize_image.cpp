#include "io/images/resize_image.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/render/srgb.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::io {

namespace {

/// The source pixels of a new pixel, from `first` on, with weights that sum to 1.
struct Taps {
    std::size_t first = 0;
    std::vector<float> weights;
    std::size_t end() const { return first + weights.size(); }
};

double sinc(double x) { return x == 0 ? 1 : sine(pi * x) / (pi * x); }
double lanczos(double x) { return std::abs(x) < 3 ? sinc(x) * sinc(x / 3) : 0; }

/// An entry for each pixel of the new side, which is `to` pixels long.
std::vector<Taps> taps_of(std::size_t from, std::size_t to) {
    const double scale = static_cast<double>(from) / static_cast<double>(to);
    std::vector<Taps> all(to);
    for (std::size_t i = 0; i < to; ++i) {
        const double centre = (static_cast<double>(i) + 0.5) * scale - 0.5; // position in source pixels
        const double low = std::max(0.0, std::ceil(centre - 3 * scale));
        const double high = std::min(static_cast<double>(from - 1), std::floor(centre + 3 * scale));
        Taps& taps = all[i];
        taps.first = static_cast<std::size_t>(low);
        std::vector<double> weights;
        double sum = 0;
        for (double x = low; x <= high; ++x) {
            weights.push_back(lanczos((x - centre) / scale));
            sum += weights.back();
        }
        for (const double w : weights) taps.weights.push_back(static_cast<float>(w / sum));
    }
    return all;
}

/// The channels of a pixel that are mixed: red, green, blue and alpha. With coverage, the colours weighted
/// by alpha are mixed too.
struct Mixing {
    PixelKind kind;
    bool coverage;

    std::size_t channels() const { return coverage ? 7 : 4; }

    void unpack(const std::uint8_t* from, std::size_t count, float* to) const {
        for (std::size_t i = 0; i < count; ++i, from += 4, to += channels()) {
            for (std::size_t c = 0; c < 3; ++c)
                to[c] = kind == PixelKind::colours   ? linear_of(from[c])
                        : kind == PixelKind::normals ? static_cast<float>(from[c]) / 127.5f - 1
                                                     : static_cast<float>(from[c]) / 255;
            to[3] = static_cast<float>(from[3]) / 255;
            for (std::size_t c = 0; coverage && c < 3; ++c) to[4 + c] = to[c] * to[3];
        }
    }

    static std::uint8_t byte_of(float x) {
        return static_cast<std::uint8_t>(std::clamp(x * 255 + 0.5f, 0.0f, 255.0f));
    }

    void pack_normal(const float* from, std::uint8_t* to) const {
        const float length = std::sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]);
        for (std::size_t c = 0; c < 3; ++c) {
            const float along = length > 0 ? from[c] / length : c == 2 ? 1.0f : 0.0f;
            to[c] = byte_of((along + 1) / 2);
        }
    }

    void pack(const float* from, std::size_t count, std::uint8_t* to) const {
        constexpr float invisible = 0.5f / 255; // smaller alpha values are rounded to 0
        for (std::size_t i = 0; i < count; ++i, from += channels(), to += 4) {
            to[3] = byte_of(from[3]);
            if (kind == PixelKind::normals) {
                pack_normal(from, to);
                continue;
            }
            const bool weighted = coverage && from[3] > invisible;
            for (std::size_t c = 0; c < 3; ++c) {
                const float mean = weighted ? from[4 + c] / from[3] : from[c];
                to[c] = kind == PixelKind::colours ? srgb_of(mean) : byte_of(mean);
            }
        }
    }
};

/// to[c] = the sum of weights[t] * from[t * step + c].
void mix(const std::vector<float>& weights, const float* from, std::size_t step, std::size_t count,
         float* to) {
    std::fill(to, to + count, 0.0f);
    for (const float w : weights) {
        for (std::size_t c = 0; c < count; ++c) to[c] += w * from[c];
        from += step;
    }
}

} // namespace

Pixels resized_image(const Pixels& image, std::size_t width, std::size_t height, PixelKind kind,
                     bool coverage) {
    const std::vector<Taps> across = taps_of(image.width, width), down = taps_of(image.height, height);
    const Mixing mixing{kind, coverage};
    const std::size_t channels = mixing.channels(), row = width * channels;
    Pixels out{width, height, std::vector<std::uint8_t>(4 * width * height), false};
    constexpr std::size_t rows = 64; // rows per batch, together with their source rows
    parallel_chunks(
        height,
        [&](std::size_t begin, std::size_t end) {
            const std::size_t first = down[begin].first, count = down[end - 1].end() - first;
            std::vector<float> old(image.width * channels), narrow(count * row), mixed(row);
            for (std::size_t y = 0; y < count; ++y) {
                mixing.unpack(&image.rgba[4 * image.width * (first + y)], image.width, old.data());
                for (std::size_t x = 0; x < width; ++x)
                    mix(across[x].weights, &old[across[x].first * channels], channels, channels,
                        &narrow[y * row + x * channels]);
            }
            for (std::size_t y = begin; y < end; ++y) {
                mix(down[y].weights, &narrow[(down[y].first - first) * row], row, row, mixed.data());
                mixing.pack(mixed.data(), width, &out.rgba[4 * width * y]);
            }
        },
        rows);
    return out;
}

} // namespace facetmill::io

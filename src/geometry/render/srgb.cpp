#include "geometry/render/srgb.hpp"

#include "base/math/portable_math.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

double linear_fraction(double encoded) {
    if (!(encoded > 0.04045)) return encoded / 12.92;
    return exponential(2.4 * logarithm((encoded + 0.055) / 1.055));
}

double srgb_fraction(double linear) {
    if (!(linear > 0.0031308)) return 12.92 * linear;
    return 1.055 * exponential(logarithm(linear) / 2.4) - 0.055;
}

namespace {

struct SrgbTables {
    static constexpr std::size_t cells = 4096;
    std::array<float, 256> linear{};
    std::array<float, 255> upper{};          ///< the linear light above which the next byte is nearer
    std::array<std::uint8_t, cells> first{}; ///< the byte at a cell's lower end

    SrgbTables() {
        for (std::size_t i = 0; i < 256; ++i)
            linear[i] = static_cast<float>(linear_fraction(static_cast<double>(i) / 255));
        for (std::size_t i = 0; i < 255; ++i)
            upper[i] = static_cast<float>(linear_fraction((static_cast<double>(i) + 0.5) / 255));
        for (std::size_t i = 0; i < cells; ++i) {
            const float low = static_cast<float>(i) / cells;
            first[i] =
                static_cast<std::uint8_t>(std::upper_bound(upper.begin(), upper.end(), low) - upper.begin());
        }
    }
};

const SrgbTables& srgb_tables() {
    static const SrgbTables tables;
    return tables;
}

} // namespace

float linear_of(std::uint8_t encoded) { return srgb_tables().linear[encoded]; }

std::uint8_t srgb_of(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    const SrgbTables& t = srgb_tables();
    std::size_t byte = t.first[static_cast<std::size_t>(linear * SrgbTables::cells)];
    while (byte < 255 && linear >= t.upper[byte]) ++byte;
    return static_cast<std::uint8_t>(byte);
}

} // namespace facetmill

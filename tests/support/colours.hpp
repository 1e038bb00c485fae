#pragma once
// sRGB bytes of linear colours, by libm instead of the product's own functions.

#include "mesh/attribute.hpp"

#include <cmath>

namespace facetmill::test {

/// IEC 61966-2-1.
inline double linear_light(double srgb) {
    return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// Component c of colour i as a byte of sRGB, and alpha as a plain byte.
inline int srgb_byte(const Attribute& a, std::size_t i, int c) {
    const double x = a.value(i, c);
    const double encoded = c == 3 ? x : x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<int>(std::lround(255 * encoded));
}

/// A colour attribute of 16 bits with the linear light of sRGB bytes.
inline AttributeData linear_words(const std::vector<std::uint8_t>& srgb, std::size_t components) {
    std::vector<std::uint16_t> words;
    words.reserve(srgb.size());
    for (std::size_t i = 0; i < srgb.size(); ++i) {
        const double x = srgb[i] / 255.0;
        words.push_back(
            static_cast<std::uint16_t>(std::lround(65535 * (i % components == 3 ? x : linear_light(x)))));
    }
    return words;
}

} // namespace facetmill::test

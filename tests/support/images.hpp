#pragma once
// Images for textures, as PNG files.

#include "io/images/pixels.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <zlib.h>

namespace facetmill::test {

/// Four bytes, big-endian.
inline std::string png_word(std::uint32_t n) {
    std::string text;
    for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(n >> shift & 255);
    return text;
}

inline std::string png_chunk(const std::string& name, const std::string& data) {
    const std::string body = name + data;
    const auto sum = ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return png_word(static_cast<std::uint32_t>(data.size())) + body +
           png_word(static_cast<std::uint32_t>(sum));
}

/// A PNG. rows: pixel rows, each after its filter byte. level: the compression level of zlib. more: chunks
/// before the pixel data.
inline std::string png_of_rows(std::uint32_t width, std::uint32_t height, char bits, char colour_type,
                               const std::string& rows, int level = -1, const std::string& more = {}) {
    uLongf size = ::compressBound(static_cast<uLong>(rows.size()));
    std::string packed(size, '\0');
    ::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(rows.data()),
                static_cast<uLong>(rows.size()), level);
    packed.resize(size);
    std::string header = png_word(width) + png_word(height);
    header += {bits, colour_type, 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + more + png_chunk("IDAT", packed) +
           png_chunk("IEND", "");
}

/// A PNG of a single pixel. colour_type: 0 grey, 2 RGB, 6 RGBA. pixel: its bytes. gamma: the value of gAMA
/// in 100000ths; 0: no gAMA.
inline std::string png_of(unsigned char colour_type, const std::string& pixel, char bits = 8,
                          std::uint32_t gamma = 0) {
    return png_of_rows(1, 1, bits, static_cast<char>(colour_type), '\0' + pixel, -1,
                       gamma ? png_chunk("gAMA", png_word(gamma)) : "");
}

inline std::string red_png() { return png_of(2, "\xff\x10\x10"); }
inline std::string blue_png() { return png_of(2, "\x10\x10\xff"); }

/// The largest difference of a channel of two images of a size.
inline int farthest(const io::Pixels& a, const io::Pixels& b) {
    if (a.rgba.size() != b.rgba.size()) return 256;
    int most = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) most = std::max(most, std::abs(a.rgba[i] - b.rgba[i]));
    return most;
}

} // namespace facetmill::test

#pragma once
// Images of one pixel, for textures.

#include <cstdint>
#include <string>
#include <zlib.h>

namespace facetmill::test {

/// A PNG of one pixel. colour_type: 0 grey, 2 RGB, 6 RGBA; pixel: its bytes; gamma: of gAMA in 100000ths, 0:
/// without.
inline std::string png_of(unsigned char colour_type, std::string pixel, char bits = 8,
                          std::uint32_t gamma = 0) {
    const auto word = [](std::uint32_t n) {
        std::string text;
        for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(n >> shift & 255);
        return text;
    };
    const auto chunk = [&](const std::string& name, const std::string& data) {
        const std::string body = name + data;
        const auto sum =
            ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
        return word(static_cast<std::uint32_t>(data.size())) + body + word(static_cast<std::uint32_t>(sum));
    };
    const std::string row = '\0' + pixel;
    std::string packed(64, '\0');
    uLongf size = packed.size();
    ::compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(row.data()),
               static_cast<uLong>(row.size()));
    packed.resize(size);
    std::string header = word(1) + word(1);
    header += {bits, static_cast<char>(colour_type), 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + (gamma ? chunk("gAMA", word(gamma)) : "") +
           chunk("IDAT", packed) + chunk("IEND", "");
}

inline std::string red_png() { return png_of(2, "\xff\x10\x10"); }
inline std::string blue_png() { return png_of(2, "\x10\x10\xff"); }

} // namespace facetmill::test

#include "io/png.hpp"

#include "base/error.hpp"

#include <zlib.h>

namespace facetmill::io {

namespace {

void put_number(Bytes& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(value >> shift & 255));
}

void put_text(Bytes& out, std::string_view text) {
    for (const char c : text) out.push_back(static_cast<std::byte>(c));
}

/// Length, type, data, checksum.
void put_chunk(Bytes& out, std::string_view type, const Bytes& data) {
    put_number(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t checked = out.size();
    put_text(out, type);
    out.insert(out.end(), data.begin(), data.end());
    const auto* begin = reinterpret_cast<const Bytef*>(out.data() + checked);
    put_number(out, static_cast<std::uint32_t>(::crc32(0, begin, static_cast<uInt>(out.size() - checked))));
}

/// Each row after the filter "sub": every byte less the one of the pixel before.
Bytes filtered(const Picture& picture) {
    const std::size_t row = static_cast<std::size_t>(picture.width) * 4;
    Bytes out;
    out.reserve((row + 1) * static_cast<std::size_t>(picture.height));
    for (std::size_t at = 0; at < picture.rgba.size(); at += row) {
        out.push_back(std::byte{1});
        for (std::size_t i = 0; i < row; ++i)
            out.push_back(
                static_cast<std::byte>(picture.rgba[at + i] - (i < 4 ? 0 : picture.rgba[at + i - 4])));
    }
    return out;
}

Bytes deflated(const Bytes& bytes, int level) {
    uLongf size = ::compressBound(bytes.size());
    Bytes out(size);
    if (::compress2(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                    bytes.size(), level) != Z_OK)
        throw out_of_memory("no memory to compress an image");
    out.resize(size);
    return out;
}

} // namespace

Bytes png(const Picture& picture) {
    Bytes header;
    put_number(header, static_cast<std::uint32_t>(picture.width));
    put_number(header, static_cast<std::uint32_t>(picture.height));
    for (const int field :
         {8, 6, 0, 0, 0}) // bits, RGBA, the only compression and filter method, not interlaced
        header.push_back(static_cast<std::byte>(field));
    Bytes out;
    put_text(out, "\x89PNG\r\n\x1a\n");
    put_chunk(out, "IHDR", header);
    // A large picture takes a third of the time for some hundredths more bytes.
    const bool large = picture.rgba.size() > std::size_t{4} << 19;
    put_chunk(out, "IDAT", deflated(filtered(picture), large ? 4 : 6));
    put_chunk(out, "IEND", {});
    return out;
}

std::string base64(Span bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t three = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        for (std::size_t i = 0; i < 3; ++i)
            three = three << 8 | (i < count ? std::to_integer<std::uint32_t>(bytes[at + i]) : 0);
        for (std::size_t i = 0; i < 4; ++i) out += i <= count ? digits[three >> (18 - 6 * i) & 63] : '=';
    }
    return out;
}

} // namespace facetmill::io

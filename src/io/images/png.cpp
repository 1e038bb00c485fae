#include "io/images/png.hpp"

#include "base/error.hpp"

#include <cstdlib>
#include <zlib.h>

namespace facetmill::io {

namespace {

void put_number(Bytes& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>(value >> shift & 255));
}

void put_text(Bytes& out, std::string_view text) {
    for (const char c : text) out.push_back(static_cast<std::byte>(c));
}

/// Appends the length, type, data and checksum of a chunk.
void put_chunk(Bytes& out, std::string_view type, const Bytes& data) {
    put_number(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t checked = out.size();
    put_text(out, type);
    out.insert(out.end(), data.begin(), data.end());
    const auto* begin = reinterpret_cast<const Bytef*>(out.data() + checked);
    put_number(out, static_cast<std::uint32_t>(::crc32(0, begin, static_cast<uInt>(out.size() - checked))));
}

enum class Filter : std::uint8_t { left = 1, paeth = 4 };

/// The Paeth predictor: left, above or corner, whichever is nearest to left + above - corner (A. W. Paeth,
/// "Image file compression made easy", 1991).
int predicted(int left, int above, int corner) {
    const int to_left = std::abs(above - corner), to_above = std::abs(left - corner),
              to_corner = std::abs(left + above - 2 * corner);
    if (to_left <= to_above && to_left <= to_corner) return left;
    return to_above <= to_corner ? above : corner;
}

/// The filtered rows: every byte minus its prediction.
Bytes filtered(const Picture& picture, Filter filter) {
    const std::size_t row = static_cast<std::size_t>(picture.width) * 4;
    Bytes out;
    out.reserve((row + 1) * static_cast<std::size_t>(picture.height));
    const std::vector<std::uint8_t> nothing(row);
    const std::uint8_t* above = nothing.data();
    for (std::size_t at = 0; at < picture.rgba.size(); at += row) {
        const std::uint8_t* own = &picture.rgba[at];
        out.push_back(static_cast<std::byte>(filter));
        for (std::size_t i = 0; i < row; ++i) {
            const int left = i < 4 ? 0 : own[i - 4];
            const int guess =
                filter == Filter::left ? left : predicted(left, above[i], i < 4 ? 0 : above[i - 4]);
            out.push_back(static_cast<std::byte>(own[i] - guess));
        }
        above = own;
    }
    return out;
}

/// strategy: one of zlib's.
Bytes deflated(const Bytes& bytes, int level, int strategy) {
    const auto no_memory = [] { return out_of_memory("no memory to compress an image"); };
    z_stream stream{};
    if (::deflateInit2(&stream, level, Z_DEFLATED, MAX_WBITS, MAX_MEM_LEVEL - 1, strategy) != Z_OK)
        throw no_memory();
    Bytes out(::deflateBound(&stream, bytes.size()));
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int end = ::deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    ::deflateEnd(&stream);
    if (end != Z_STREAM_END) throw no_memory();
    return out;
}

Bytes image_data(const Picture& picture, PngEffort effort) {
    if (effort == PngEffort::fast) return deflated(filtered(picture, Filter::paeth), 1, Z_RLE);
    // For large pictures, level 4 takes a third of the time for a few percent more bytes.
    const bool large = picture.rgba.size() > std::size_t{4} << 19;
    return deflated(filtered(picture, Filter::left), large ? 4 : 6, Z_DEFAULT_STRATEGY);
}

} // namespace

Bytes png(const Picture& picture, PngEffort effort) {
    Bytes header;
    put_number(header, static_cast<std::uint32_t>(picture.width));
    put_number(header, static_cast<std::uint32_t>(picture.height));
    for (const int field :
         {8, 6, 0, 0, 0}) // 8 bits, RGBA, the only compression and filter methods, not interlaced
        header.push_back(static_cast<std::byte>(field));
    Bytes out;
    put_text(out, "\x89PNG\r\n\x1a\n");
    put_chunk(out, "IHDR", header);
    put_chunk(out, "IDAT", image_data(picture, effort));
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

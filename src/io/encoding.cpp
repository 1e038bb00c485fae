#include "io/encoding.hpp"

#include "base/error.hpp"

#include <cstdint>
#include <fmt/format.h>

namespace facetmill::io {

namespace {

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF", little_mark = "\xFF\xFE", big_mark = "\xFE\xFF";
constexpr std::string_view little_utf32{"\xFF\xFE\0\0", 4}, big_utf32{"\0\0\xFE\xFF", 4};

enum class Encoding { utf8, marked_utf8, utf16_little, utf16_big, utf32 };

[[noreturn]] void cannot_decode(const Input& input, const std::string& message) {
    throw Error(ErrorKind::malformed, "E-ENCODING", fmt::format("'{}' {}", input.name(), message),
                "save it as UTF-8");
}

bool is_plain(char c) { return (c >= ' ' && c <= '~') || c == '\t' || c == '\n' || c == '\r'; }

/// Whether the text starts with ASCII characters that alternate with zero bytes.
bool alternates(std::string_view text, std::size_t character) {
    constexpr std::size_t pairs = 8;
    if (text.size() < 2 * pairs) return false;
    for (std::size_t i = 0; i < 2 * pairs; i += 2)
        if (!is_plain(text[i + character]) || text[i + 1 - character] != '\0') return false;
    return true;
}

Encoding encoding_of(std::string_view text) {
    if (text.starts_with(utf8_mark)) return Encoding::marked_utf8;
    if (text.starts_with(little_utf32) || text.starts_with(big_utf32)) return Encoding::utf32;
    if (text.starts_with(little_mark) || alternates(text, 0)) return Encoding::utf16_little;
    if (text.starts_with(big_mark) || alternates(text, 1)) return Encoding::utf16_big;
    return Encoding::utf8;
}

void append_utf8(Bytes& out, std::uint32_t code) {
    const auto put = [&](std::uint32_t byte) { out.push_back(static_cast<std::byte>(byte)); };
    const auto follow = [&](int shift) { put(0x80 | ((code >> shift) & 0x3f)); };
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xc0 | (code >> 6));
        follow(0);
    } else if (code < 0x10000) {
        put(0xe0 | (code >> 12));
        follow(6);
        follow(0);
    } else {
        put(0xf0 | (code >> 18));
        follow(12);
        follow(6);
        follow(0);
    }
}

/// Converts the UTF-16 bytes after an optional mark, in that byte order.
Bytes from_utf16(const Input& input, bool big) {
    const Span bytes = input.bytes();
    std::size_t at = as_text(bytes).starts_with(big ? big_mark : little_mark) ? 2 : 0;
    const auto unit = [&](std::size_t i) {
        const auto high = std::to_integer<std::uint32_t>(bytes[i + (big ? 0 : 1)]);
        return high << 8 | std::to_integer<std::uint32_t>(bytes[i + (big ? 1 : 0)]);
    };
    if ((bytes.size() - at) % 2 != 0) cannot_decode(input, "is UTF-16 and ends within a character");
    Bytes out;
    out.reserve((bytes.size() - at) / 2);
    while (at < bytes.size()) {
        std::uint32_t code = unit(at);
        at += 2;
        if (code >= 0xd800 && code < 0xe000) { // half of a surrogate pair (RFC 2781)
            const std::uint32_t low = at < bytes.size() ? unit(at) : 0;
            if (code >= 0xdc00 || low < 0xdc00 || low >= 0xe000)
                cannot_decode(input,
                              fmt::format("is UTF-16 with half of a surrogate pair at byte {}", at - 2));
            code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
            at += 2;
        }
        append_utf8(out, code);
    }
    return out;
}

} // namespace

Input in_utf8(const Input& input) {
    switch (const Encoding encoding = encoding_of(as_text(input.bytes()))) {
    case Encoding::utf8:
        break;
    case Encoding::marked_utf8:
        return input.from(utf8_mark.size());
    case Encoding::utf16_little:
    case Encoding::utf16_big:
        return input.with(from_utf16(input, encoding == Encoding::utf16_big));
    case Encoding::utf32:
        cannot_decode(input, "is UTF-32, which facetmill cannot read");
    }
    return input;
}

bool is_plain_utf8(const Input& input) { return encoding_of(as_text(input.bytes())) == Encoding::utf8; }

} // namespace facetmill::io

// Makes std::filesystem::path take text as UTF-8, as path::string() returns it. libstdc++ 12 converts text by
// the locale of C, and the C library has no locale with UTF-8. The linker passes all calls of mbrtowc here
// (--wrap, cmake/Windows.cmake).

#include <cstddef>
#include <cstdint>
#include <cwchar>
#include <string_view>

namespace facetmill {

namespace {

constexpr std::size_t incomplete = static_cast<std::size_t>(-2);
constexpr std::uint32_t not_utf8 = 0xffffffff;

/// The number of bytes of a character that begins with this byte, or 0.
std::size_t length_of(unsigned char first) {
    return first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
}

/// Its code point, or not_utf8. `text` has all of its bytes.
std::uint32_t code_point(std::string_view text) {
    constexpr std::uint32_t first_bits[] = {0, 0x7f, 0x1f, 0x0f, 0x07},
                            least[] = {0, 0, 0x80, 0x800, 0x10000};
    std::uint32_t code = static_cast<unsigned char>(text[0]) & first_bits[text.size()];
    for (const char c : text.substr(1)) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xc0) != 0x80) return not_utf8;
        code = code << 6 | (byte & 0x3fU);
    }
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    return code < least[text.size()] || code > 0x10ffff || is_surrogate ? not_utf8 : code;
}

} // namespace

} // namespace facetmill

/// Bytes that are not UTF-8 are read as Latin-1, as old OBJ and MTL files have them. A character beyond 16
/// bits gives two units: its first three bytes the first, and its last byte the second, which the state keeps
/// until then.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t size,
                                      std::mbstate_t* state) {
    using namespace facetmill;
    static thread_local std::mbstate_t own{};
    std::mbstate_t& second = state ? *state : own;
    if (!from) {
        second = {};
        return 0;
    }
    if (size == 0) return incomplete;
    if (second != 0) {
        if (to) *to = static_cast<wchar_t>(second);
        second = {};
        return 1;
    }
    const std::size_t length = length_of(static_cast<unsigned char>(*from));
    const bool is_whole = length > 0 && length <= size;
    const std::uint32_t code = is_whole ? code_point({from, length}) : not_utf8;
    if (code == not_utf8) {
        if (to) *to = static_cast<unsigned char>(*from);
        return 1;
    }
    if (length < 4) {
        if (to) *to = static_cast<wchar_t>(code);
        return code == 0 ? 0 : length;
    }
    const std::uint32_t rest = code - 0x10000;
    if (to) *to = static_cast<wchar_t>(0xd800 + (rest >> 10));
    second = static_cast<std::mbstate_t>(0xdc00 + (rest & 0x3ff));
    return 3;
}

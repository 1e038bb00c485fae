#pragma once
// Small matters of text that is read, or told.

#include <cstddef>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// The noun for so many: "face" for 1, else its plural, which is the noun and an s unless given.
inline std::string noun_for(std::size_t count, std::string_view noun, std::string_view plural = {}) {
    if (count == 1) return std::string(noun);
    return plural.empty() ? std::string(noun) + "s" : std::string(plural);
}

/// "1 face", "2 faces".
inline std::string counted(std::size_t count, std::string_view noun, std::string_view plural = {}) {
    return fmt::format("{} {}", count, noun_for(count, noun, plural));
}

/// The text behind the mark of UTF-8 that some editors put at its beginning.
inline std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

/// The text without spaces and tabs at its ends.
std::string_view trimmed(std::string_view text);

/// What stands between commas, without blanks around it: "a, b" is a and b. Two commas have an empty item
/// between them, as have a comma and an end, so that who reads the items can refuse it; a blank text has
/// none.
std::vector<std::string_view> split_at_commas(std::string_view text);

/// Adds an item to a list in text; an empty one adds nothing.
void append_item(std::string& list, std::string_view item, std::string_view between = ", ");

/// The items that are not empty, one after the other.
std::string join_texts(const std::vector<std::string>& texts, std::string_view between = ", ");

/// Bytes of the UTF-8 sequence at i; 0 when it is none (cut short, overlong, a surrogate, beyond U+10FFFF).
std::size_t utf8_length(std::string_view text, std::size_t i);

} // namespace facetmill

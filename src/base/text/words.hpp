#pragma once
// Text helpers.

#include <cstddef>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// The noun for this count: "face" for 1, otherwise its plural, by default the noun and an s.
[[nodiscard]] inline std::string noun_for(std::size_t count, std::string_view noun,
                                          std::string_view plural = {}) {
    if (count == 1) return std::string(noun);
    return plural.empty() ? std::string(noun) + "s" : std::string(plural);
}

/// The count with its noun: "1 face", "2 faces".
[[nodiscard]] inline std::string counted(std::size_t count, std::string_view noun,
                                         std::string_view plural = {}) {
    return fmt::format("{} {}", count, noun_for(count, noun, plural));
}

/// The text without the UTF-8 byte order mark that some editors add.
[[nodiscard]] inline std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

/// The text without spaces and tabs at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The texts between commas, without blanks around them: "a, b" gives a and b. Two commas, or a comma and an
/// end, enclose an empty item, which the caller can refuse. A blank text has no items.
[[nodiscard]] std::vector<std::string_view> split_at_commas(std::string_view text);

/// Adds an item to a list in text. An empty item adds nothing.
void append_item(std::string& list, std::string_view item, std::string_view between = ", ");

/// Joins the items that are not empty.
[[nodiscard]] std::string join_texts(const std::vector<std::string>& texts, std::string_view between = ", ");

/// The length of the UTF-8 sequence at i; 0 if it is invalid (truncated, overlong, a surrogate, beyond
/// U+10FFFF).
[[nodiscard]] std::size_t utf8_length(std::string_view text, std::size_t i);

} // namespace facetmill

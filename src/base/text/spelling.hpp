#pragma once
// Compares words as people type them: ignoring case, and finding the nearest valid name.

#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// Lower-cases A to Z; other bytes stay, so that UTF-8 stays valid.
[[nodiscard]] std::string lower_case(std::string text);
/// Whether the texts are equal, ignoring the case of A to Z.
bool same_word(std::string_view a, std::string_view b);

/// The number of single-character insertions, deletions, replacements and swaps of neighbours between a and
/// b.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to the word (the first of ties), or empty if none is near enough.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The text "did you mean 'x'?" if a candidate is near enough, otherwise `otherwise`.
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates,
                                       std::string otherwise = {});

/// The text "did you mean 'x'?" if a candidate is near enough, otherwise "expected one of: a, b, c".
[[nodiscard]] std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

} // namespace facetmill

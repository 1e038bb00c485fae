#pragma once
// Hints for names of options and properties in other programs: watertight, target_faces.

#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// Names in other programs for an option or a property.
struct Synonyms {
    std::string words; ///< separated by blanks
    std::string how;   ///< the text to write, if the name alone does not show it
};

struct KnownName {
    std::string name;
    std::vector<Synonyms> synonyms = {};
};

/// Whether the word is one of the blank-separated words.
bool has_word(std::string_view words, std::string_view word);

/// The known names that other programs call by this word, in alphabetical order.
[[nodiscard]] std::vector<std::string> options_called(std::string_view word,
                                                      const std::vector<KnownName>& known);

/// Like options_called, without names whose value has another meaning, such as ratio for reduction.
[[nodiscard]] std::vector<std::string> options_of_same_value(std::string_view word,
                                                             const std::vector<KnownName>& known);

/// Whether other programs use this word for a report, which here is an option of the command.
bool means_report(std::string_view option);

/// A hint for an unknown word: the name with this meaning, the nearest name, or `otherwise`. If `otherwise`
/// is empty, the list of all names.
[[nodiscard]] std::string hint_for_option(std::string_view word, const std::vector<KnownName>& known,
                                          std::string otherwise = {});

} // namespace facetmill

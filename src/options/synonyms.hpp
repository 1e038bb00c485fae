#pragma once
// Hints for words that are no options or properties here, but are in other programs: watertight,
// target_faces.

#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// What other programs call an option or a property, which has one name here.
struct Synonyms {
    std::string words; ///< separated by blanks
    std::string how;   ///< what to write, where the name alone does not say it
};

struct KnownName {
    std::string name;
    std::vector<Synonyms> synonyms = {};
};

/// Whether the word is one of those that blanks separate.
bool has_word(std::string_view words, std::string_view word);

/// The known names that other programs call by this word, in alphabetical order.
[[nodiscard]] std::vector<std::string> options_called(std::string_view word,
                                                      const std::vector<KnownName>& known);

/// The same without names whose value means something else, such as ratio for reduction.
[[nodiscard]] std::vector<std::string> options_of_same_value(std::string_view word,
                                                             const std::vector<KnownName>& known);

/// Whether other programs call a report by this word. Here a report is an option of the command.
bool means_report(std::string_view option);

/// A hint for a word that is no known name: the name here, the nearest name, or `otherwise`. Without
/// `otherwise`: the list of all names.
[[nodiscard]] std::string hint_for_option(std::string_view word, const std::vector<KnownName>& known,
                                          std::string otherwise = {});

} // namespace facetmill

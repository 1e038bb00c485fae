#pragma once
// What other programs call options and properties: watertight, target_faces, merge_vertices. For hints only;
// an option has one name. What they call stages is in stage/other_names.hpp.

#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// The names among those known that other programs call so, whatever value they take; none when there is
/// none.
std::vector<std::string> options_called(std::string_view other_name, const std::vector<std::string>& known);

/// The same without those whose value means something else: not ratio, the share that stays, for reduction.
std::vector<std::string> options_of_same_value(std::string_view other_name,
                                               const std::vector<std::string>& known);

/// Whether other programs call a report so, which here is an option of the command and not of a stage.
bool means_report(std::string_view option);

/// What to say about a word that is none of the known names: what it is called here, the nearest of them, or
/// otherwise. Empty: the list of all known.
std::string hint_for_option(std::string_view word, const std::vector<std::string>& known,
                            std::string otherwise = {});

} // namespace facetmill

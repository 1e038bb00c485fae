#pragma once
// Names of options and properties in other programs: watertight, target_faces, merge_vertices. For hints
// only; an option has one name. Names of stages are in stage/other_names.hpp.

#include <string>
#include <string_view>
#include <vector>

namespace facetmill {

/// The known names that correspond to another program's name, whatever their values; empty if none do.
std::vector<std::string> options_called(std::string_view other_name, const std::vector<std::string>& known);

/// The same without names whose value has another meaning: not ratio, the remaining share, for reduction.
std::vector<std::string> options_of_same_value(std::string_view other_name,
                                               const std::vector<std::string>& known);

/// Whether other programs call a report so, which here is an option of the command and not of a stage.
bool means_report(std::string_view option);

/// The hint for an unknown word: its name here, the nearest known names, or otherwise. Empty: the list of
/// all known names.
std::string hint_for_option(std::string_view word, const std::vector<std::string>& known,
                            std::string otherwise = {});

} // namespace facetmill

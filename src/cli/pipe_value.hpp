#pragma once
// Converts words of a one-liner to option values: percentages, expressions, lists, and YAML in an argument.

#include "options/declaration.hpp"

namespace facetmill::cli {

/// Converts an argument to a value of that option (null: unknown). "@{x}" becomes "${x}" and "50pct" becomes
/// "50%". Vectors and lists are split at commas; lists of paths are not, because a path may contain a comma.
/// Text in braces, or in nested brackets, is YAML if the option accepts such values; problems of that YAML
/// are added.
[[nodiscard]] Value pipe_value(std::string text, const Option* option, const Mark& mark, Problems& problems);

/// @{x} -> ${x}; @@{ stays @{.
[[nodiscard]] std::string expressions(std::string text);

/// Numbers alone form a single value if a value may itself be a list. For example, four numbers are a plane,
/// not four planes.
[[nodiscard]] Value as_one_value(Value list, const Option& option);

} // namespace facetmill::cli

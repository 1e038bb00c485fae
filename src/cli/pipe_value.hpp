#pragma once
// Words of a one-liner as values of options: percentages, expressions, lists, and YAML in one argument.

#include "options/declaration.hpp"

namespace facetmill::cli {

/// An argument as a value of that option (null: unknown): "@{x}" is "${x}", "50pct" is "50%", vectors and
/// lists are split at commas (lists of paths are not: a path may hold a comma), and what stands in braces, or
/// in brackets within brackets, is read as YAML where the option may be such a thing. Problems of that YAML
/// are added.
Value pipe_value(std::string text, const Option* option, const Mark& mark, Problems& problems);

/// @{x} -> ${x}; @@{ stays @{.
std::string expressions(std::string text);

/// Four numbers are one plane and not four: where one value may be a list itself, numbers alone are one
/// value.
Value as_one_value(Value list, const Option& option);

} // namespace facetmill::cli

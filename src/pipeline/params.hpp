#pragma once
// The typed parameters of a pipeline, and their values from -D and defaults.

#include "pipeline/expressions.hpp"
#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

/// The variables that `params` declares, with their values from -D or their defaults. json receives the
/// values for the report. Adds E-PARAM and the problems of the values' types.
[[nodiscard]] Scope read_params(const Value* params, const PlanSettings& settings, Json& json,
                                Problems& problems);

/// The values of an included document: its params with the given values (a map), otherwise their defaults.
[[nodiscard]] Scope fragment_params(const Value& document, const Value& given, const PlanSettings& settings,
                                    Problems& problems);

/// The types of a param except list, which are also the types of a list's values.
[[nodiscard]] std::vector<std::string> single_param_types();

/// A mark on the command line: "-D keep=10%" with the caret under it.
[[nodiscard]] Mark command_line_mark(const std::string& option, const std::string& text,
                                     std::size_t from = 0);

/// Scalars as typed JSON, other values unchanged.
[[nodiscard]] Json value_json(const Value& value);

} // namespace facetmill::pipeline

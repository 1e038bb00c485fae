#pragma once
// The typed parameters of a pipeline, and their values from -D and defaults.

#include "pipeline/expressions.hpp"
#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

/// The variables that `params` declares, with their values: -D, else the default. json gets the values for
/// the report. Adds E-PARAM and what the types of values add.
Scope read_params(const Value* params, const PlanSettings& settings, Json& json, Problems& problems);

/// The same for a document that is included: its params with the values that are given (a map), else their
/// defaults.
Scope fragment_params(const Value& document, const Value& given, const PlanSettings& settings,
                      Problems& problems);

/// The types of a param, besides list: what the values of a list may be.
std::vector<std::string> single_param_types();

/// A place on the command line: "-D keep=10%" with the caret under it.
Mark command_line_mark(const std::string& option, const std::string& text, std::size_t from = 0);

/// Scalars as typed JSON, the rest as it is.
Json value_json(const Value& value);

} // namespace facetmill::pipeline

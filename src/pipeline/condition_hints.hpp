#pragma once
// Conditions without an expression in them, "faces > 1000": what was meant.

#include "pipeline/expressions.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace facetmill::pipeline {

/// The comparison operator outside of ${...}: where it begins, and itself.
std::optional<std::pair<std::size_t, std::string>> find_operator(std::string_view text);

struct MeantCondition {
    std::string message, hint;
};

/// What a comparison of two plain words means, when one of them is a property of the scene or a variable: as
/// words they never change. None when neither is.
std::optional<MeantCondition> meant_comparison(std::string_view left, std::string_view op,
                                               std::string_view right, const Scope& scope);

/// What several conditions about properties in one text mean, joined by && or "and": a map, all of which must
/// hold; "or" has no form. None when the text is no such thing.
std::optional<MeantCondition> meant_conditions(std::string_view text);

/// What to write for the name of a property alone, "closed" or "not closed"; empty when it is none.
std::string hint_of_property_alone(std::string_view text);

} // namespace facetmill::pipeline

#pragma once
// Conditions without an expression in them, "faces > 1000": what was meant.

#include "pipeline/expressions.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace facetmill::pipeline {

struct MeantCondition {
    std::string message, hint;
};

/// What a comparison of two plain words means, when one of them is a property of the scene or a variable: as
/// words they never change. None when neither is.
std::optional<MeantCondition> meant_comparison(std::string_view left, std::string_view op,
                                               std::string_view right, const Scope& scope);

/// What to write for the name of a property alone, "closed" or "not closed"; empty when it is none.
std::string hint_of_property_alone(std::string_view text);

} // namespace facetmill::pipeline

#pragma once
// Hints for conditions that are not expressions, such as "faces > 1000".

#include "pipeline/expressions.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace facetmill::pipeline {

/// The comparison operator outside of ${...}: its position and its text.
[[nodiscard]] std::optional<std::pair<std::size_t, std::string>> find_operator(std::string_view text);

struct MeantCondition {
    std::string message, hint;
};

/// The intended condition of a comparison of two plain words, if one is a property of the scene or a
/// variable. As plain words, the comparison never changes. None for other words.
[[nodiscard]] std::optional<MeantCondition> meant_comparison(std::string_view left, std::string_view op,
                                                             std::string_view right, const Scope& scope);

/// The intended conditions of a text about properties, joined by && or "and": a map with all of them. "or"
/// cannot be expressed. None for other texts.
[[nodiscard]] std::optional<MeantCondition> meant_conditions(std::string_view text);

/// The condition to write for a property alone, "closed" or "not closed"; empty for other texts.
[[nodiscard]] std::string hint_of_property_alone(std::string_view text);

} // namespace facetmill::pipeline

#include "pipeline/condition_hints.hpp"

#include "base/numbers.hpp"
#include "base/words.hpp"
#include "geometry/inspect/inspect.hpp"
#include "options/other_names.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

/// By its name, or by what other programs call it.
const Property* property_meant(std::string_view word) {
    if (const Property* property = property_named(word)) return property;
    std::vector<std::string> names;
    for (const Property& property : property_table()) names.emplace_back(property.name);
    const auto called = options_alike(word, names);
    return called.empty() ? nullptr : property_named(called.front());
}

/// The operator when its sides are exchanged.
std::string_view exchanged(std::string_view op) {
    if (op == "<") return ">";
    if (op == "<=") return ">=";
    if (op == ">") return "<";
    return op == ">=" ? "<=" : op;
}

/// "{min: 1001}" for "> 1000"; empty when there is no bound like that.
std::string bound_text(PropertyKind kind, std::string_view op, std::string_view value) {
    const bool truth = kind == PropertyKind::truth;
    if (truth && (value == "true" || value == "false") && (op == "==" || op == "!="))
        return (value == "true") == (op == "==") ? "true" : "false";
    if (kind == PropertyKind::word) return op == "==" ? std::string(value) : "";
    const bool length = kind == PropertyKind::length;
    const auto number = parse_integer(value);
    if (truth || kind == PropertyKind::box || (kind == PropertyKind::count && !number)) return {};
    if (!(length ? value.find_first_of("0123456789") != value.npos : parse_real(value).has_value()))
        return {};
    if (op == "==") return std::string(value);
    // Bounds hold at their ends: of counts the next one is meant.
    const bool next = kind == PropertyKind::count && number && (op == "<" || op == ">");
    const std::string end = next ? std::to_string(*number + (op == ">" ? 1 : -1)) : std::string(value);
    if (op == ">" || op == ">=") return fmt::format("{{min: {}}}", end);
    return op == "<" || op == "<=" ? fmt::format("{{max: {}}}", end) : "";
}

/// None for a word that only other programs call the property by and that is compared with another word:
/// texts may well be points and solid.
std::optional<MeantCondition> of_property(std::string_view name, std::string_view op,
                                          std::string_view value) {
    const Property* meant = property_meant(name);
    if (!meant) return {};
    const Property& property = *meant;
    std::string bound = bound_text(property.kind, op, value);
    if (bound.empty() && property.name != name && (op == "==" || op == "!=")) return {};
    if (bound.empty())
        bound = property.kind == PropertyKind::truth || property.kind == PropertyKind::word
                    ? "..."
                    : "{min: ..., max: ...}";
    return MeantCondition{
        fmt::format("'{}' is a property of the scene, which is not compared by an operator", property.name),
        fmt::format("write when: {{{}: {}}}", property.name, bound)};
}

} // namespace

std::optional<MeantCondition> meant_comparison(std::string_view left, std::string_view op,
                                               std::string_view right, const Scope& scope) {
    if (left.find("${") != left.npos || right.find("${") != right.npos) return {};
    for (const std::string_view side : {left, right})
        if (find_variable(scope, side)) {
            const auto shown = [&](std::string_view text) {
                return text == side ? fmt::format("${{{}}}", text) : std::string(text);
            };
            return MeantCondition{fmt::format("'{}' is compared as a word here, which never changes", side),
                                  fmt::format("write {} {} {}", shown(left), op, shown(right))};
        }
    if (auto meant = of_property(left, op, right)) return meant;
    return of_property(right, exchanged(op), left);
}

std::string hint_of_property_alone(std::string_view text) {
    std::string_view word = text;
    bool is = true;
    for (const std::string_view no : {"not ", "!"})
        if (word.starts_with(no)) {
            word = trimmed(word.substr(no.size()));
            is = false;
        }
    const Property* property = property_meant(word);
    if (!property) return {};
    return fmt::format("write when: {{{}: {}}}", property->name,
                       !property->truth() ? "{min: ..., max: ...}"
                       : is               ? "true"
                                          : "false");
}

} // namespace facetmill::pipeline

#include "pipeline/condition_hints.hpp"

#include "base/math/numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/inspect/inspect.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <initializer_list>
#include <utility>
#include <vector>

namespace facetmill::pipeline {

namespace {

/// Finds a property by its name, or by its name in other programs.
const Property* property_meant(std::string_view word) {
    if (const Property* property = property_named(word)) return property;
    const auto called = options_of_same_value(word, known_properties());
    return called.empty() ? nullptr : property_named(called.front());
}

/// The operator after exchanging its sides.
std::string_view exchanged(std::string_view op) {
    if (op == "<") return ">";
    if (op == "<=") return ">=";
    if (op == ">") return "<";
    return op == ">=" ? "<=" : op;
}

/// "{min: 1001}" for "> 1000"; empty if there is no such bound.
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
    // Bounds include their ends, so for counts a strict comparison becomes the next integer.
    const bool next = kind == PropertyKind::count && number && (op == "<" || op == ">");
    const std::string end = next ? std::to_string(*number + (op == ">" ? 1 : -1)) : std::string(value);
    if (op == ">" || op == ">=") return fmt::format("{{min: {}}}", end);
    return op == "<" || op == "<=" ? fmt::format("{{max: {}}}", end) : "";
}

struct MeantBound {
    const Property* property = nullptr;
    std::string bound; ///< "{min: 1001}"; empty if there is no such bound
};

/// None for another program's name of a property that is compared with another word. Both may be plain texts,
/// for example points and solid.
std::optional<MeantBound> bound_of(std::string_view name, std::string_view op, std::string_view value) {
    const Property* meant = property_meant(name);
    if (!meant) return {};
    std::string bound = bound_text(meant->kind, op, value);
    if (bound.empty() && meant->name != name && (op == "==" || op == "!=")) return {};
    return MeantBound{meant, std::move(bound)};
}

/// The bound for only a property: "closed", "not closed".
std::optional<MeantBound> property_alone(std::string_view text) {
    bool is = true;
    for (const std::string_view no : {"not ", "!"})
        if (text.starts_with(no)) {
            text = trimmed(text.substr(no.size()));
            is = false;
        }
    const Property* property = property_meant(text);
    if (!property) return {};
    return MeantBound{property, !property->truth() ? "" : is ? "true" : "false"};
}

std::string shown(const MeantBound& meant) {
    const PropertyKind kind = meant.property->kind;
    const bool one = kind == PropertyKind::truth || kind == PropertyKind::word;
    return !meant.bound.empty() ? meant.bound : one ? "..." : "{min: ..., max: ...}";
}

std::optional<MeantCondition> of_property(std::string_view name, std::string_view op,
                                          std::string_view value) {
    const auto meant = bound_of(name, op, value);
    if (!meant) return {};
    return MeantCondition{
        fmt::format("'{}' is a property of the scene, which operators cannot compare", meant->property->name),
        fmt::format("write when: {{{}: {}}}", meant->property->name, shown(*meant))};
}

/// The bound for a single condition: a comparison with the property on either side, or only a property.
std::optional<MeantBound> one_bound(std::string_view text) {
    const auto found = find_operator(text);
    if (!found) return property_alone(text);
    const auto& [at, op] = *found;
    const std::string_view left = trimmed(text.substr(0, at)), right = trimmed(text.substr(at + op.size()));
    auto meant = bound_of(left, op, right);
    return meant ? meant : bound_of(right, exchanged(op), left);
}

/// Splits at the given words, and ignores everything else.
std::vector<std::string_view> split_at(std::string_view text, std::initializer_list<std::string_view> words) {
    std::vector<std::string_view> parts;
    std::size_t begin = 0;
    for (std::size_t at = 0; at < text.size(); ++at)
        for (const std::string_view word : words)
            if (text.substr(at).starts_with(word)) {
                parts.push_back(trimmed(text.substr(begin, at - begin)));
                begin = at + word.size();
                at = begin - 1;
                break;
            }
    parts.push_back(trimmed(text.substr(begin)));
    return parts;
}

/// "faces: {min: 1001}, closed: true"; both bounds of a property share braces.
std::string as_map(const std::vector<MeantBound>& all) {
    std::vector<std::pair<std::string_view, std::string>> entries;
    for (const MeantBound& one : all) {
        const auto same = std::find_if(entries.begin(), entries.end(),
                                       [&](const auto& e) { return e.first == one.property->name; });
        std::string bound = shown(one);
        if (same == entries.end())
            entries.emplace_back(one.property->name, std::move(bound));
        else if (same->second.ends_with('}') && bound.starts_with('{'))
            same->second = same->second.substr(0, same->second.size() - 1) + ", " + bound.substr(1);
    }
    std::vector<std::string> texts;
    texts.reserve(entries.size());
    for (const auto& [name, bound] : entries) texts.push_back(fmt::format("{}: {}", name, bound));
    return fmt::format("{}", fmt::join(texts, ", "));
}

} // namespace

std::optional<std::pair<std::size_t, std::string>> find_operator(std::string_view text) {
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text.compare(at, 2, "${") == 0) {
            at = std::min(text.size(), text.find('}', at));
            continue;
        }
        for (const char* op : {"==", "!=", "<=", ">=", "<", ">"})
            if (text.compare(at, std::char_traits<char>::length(op), op) == 0)
                return std::pair{at, std::string(op)};
    }
    return {};
}

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

std::optional<MeantCondition> meant_conditions(std::string_view text) {
    const auto parts = split_at(text, {"&&", " and ", " AND ", "||", " or ", " OR "});
    if (parts.size() < 2) return {};
    std::vector<MeantBound> all;
    for (const std::string_view part : parts) {
        const auto meant = one_bound(part);
        if (!meant) return {};
        all.push_back(*meant);
    }
    const bool any = split_at(text, {"||", " or ", " OR "}).size() > 1;
    return MeantCondition{
        "several conditions in one text, but here each condition is an entry of a map",
        any ? fmt::format("write when: {{{}}} where all must hold; there is no 'or'", as_map(all))
            : fmt::format("write when: {{{}}}, all of which must hold", as_map(all))};
}

std::string hint_of_property_alone(std::string_view text) {
    const auto meant = property_alone(text);
    return meant ? fmt::format("write when: {{{}: {}}}", meant->property->name, shown(*meant)) : "";
}

} // namespace facetmill::pipeline

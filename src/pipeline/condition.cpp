#include "base/math/numbers.hpp"
#include "base/text/words.hpp"
#include "pipeline/condition_hints.hpp"
#include "pipeline/planner.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

/// A number or a percentage, for texts of unknown type.
std::optional<Comparable> untyped(const std::string& text) {
    if (text.ends_with('%'))
        if (const auto number = parse_real(text.substr(0, text.size() - 1)))
            return Comparable{*number / 100, ""};
    return Comparable{parse_real(text), ""};
}

/// The declared parameter if the whole text is "${name}".
const Variable* parameter(const std::string& text, const Scope& scope) {
    if (!text.starts_with("${") || !text.ends_with('}')) return nullptr;
    const Variable* variable = find_variable(scope, text.substr(2, text.size() - 3));
    return variable && variable->comparable ? variable : nullptr;
}

bool ordered(double a, double b, const std::string& op) {
    if (op == "==") return a == b;
    if (op == "!=") return a != b;
    if (op == "<") return a < b;
    if (op == "<=") return a <= b;
    return op == ">" ? a > b : a >= b;
}

/// Compares by the type of the parameter on either side, if there is one.
std::optional<bool> compare(const Value& value, const Value& left, const std::string& op, const Value& right,
                            const Variable* typed, Problems& problems) {
    const auto read = [&](const Value& side) {
        return typed ? typed->comparable(side, problems) : untyped(side.text);
    };
    const auto a = read(left), b = read(right);
    if (!a || !b) return {};
    if (a->number && b->number && a->kind == b->kind) return ordered(*a->number, *b->number, op);
    if (a->kind == b->kind && op == "==") return left.text == right.text;
    if (a->kind == b->kind && op == "!=") return left.text != right.text;
    if (a->kind != b->kind)
        problems.add(value.mark, "E-WHEN",
                     fmt::format("'{}' is in {} and '{}' in {}: they cannot be compared", left.text, a->kind,
                                 right.text, b->kind));
    else
        problems.add(value.mark, "E-WHEN",
                     fmt::format("'{}' compares numbers, found '{}' and '{}'", op, left.text, right.text),
                     right.text.starts_with('=') || left.text.ends_with('=')
                         ? "the operators are ==, !=, <, <=, > and >="
                         : "texts can be compared by == and !=");
    return {};
}

} // namespace

Condition read_condition(const Value& value, const Scope& scope, Problems& problems) {
    Condition condition;
    condition.where = value.mark;
    if (value.is_map()) {
        parse_assertions(resolved(value, scope, problems), condition.predicates, "when", problems);
        return condition;
    }
    condition.known = true; // so that problems in the following text are reported too
    if (auto meant = value.is_scalar() ? meant_conditions(value.text) : std::nullopt) {
        problems.add(value.mark, "E-WHEN", std::move(meant->message), std::move(meant->hint));
        return condition;
    }
    const auto found = value.is_scalar() ? find_operator(value.text) : std::nullopt;
    if (!found) {
        const Value is = resolved(value, scope, problems);
        if (is.deferred) return condition;
        if (const auto truth = is.as_bool()) {
            condition.known = truth;
            return condition;
        }
        const std::string hint = value.is_scalar() ? hint_of_property_alone(value.text) : "";
        problems.add(
            value.mark, "E-WHEN",
            fmt::format("expected true, false, a comparison or properties, found {}", is.described()),
            hint.empty() ? "when: \"${flag}\", when: ${quality} == high, or when: {closed: false}" : hint);
        return condition;
    }
    const auto [at, op] = *found;
    const std::string_view text = value.text;
    const std::string texts[] = {std::string(trimmed(text.substr(0, at))),
                                 std::string(trimmed(text.substr(at + op.size())))};
    if (auto meant = meant_comparison(texts[0], op, texts[1], scope)) {
        problems.add(value.mark, "E-WHEN", std::move(meant->message), std::move(meant->hint));
        return condition;
    }
    Value sides[2];
    for (std::size_t i = 0; i < 2; ++i)
        sides[i] = resolved(Value::scalar(texts[i], mark_within(value.mark, texts[i])), scope, problems);
    const Variable* typed = parameter(texts[0], scope);
    if (!typed) typed = parameter(texts[1], scope);
    // The other side of a parameter is checked even if the parameter's own value is unknown.
    if (typed && sides[0].deferred != sides[1].deferred)
        typed->comparable(sides[sides[0].deferred ? 1 : 0], problems);
    if (sides[0].deferred || sides[1].deferred) return condition;
    if (const auto truth = compare(value, sides[0], op, sides[1], typed, problems)) condition.known = truth;
    return condition;
}

} // namespace facetmill::pipeline

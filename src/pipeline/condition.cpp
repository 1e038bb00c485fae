#include "base/numbers.hpp"
#include "pipeline/planner.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The comparison operator outside of ${...}: where it begins, and itself.
std::optional<std::pair<std::size_t, std::string>> find_operator(const std::string& text) {
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

/// A number or a percentage.
std::optional<double> comparable(const std::string& text) {
    if (text.ends_with('%'))
        if (const auto number = parse_real(text.substr(0, text.size() - 1))) return *number / 100;
    return parse_real(text);
}

bool ordered(double a, double b, const std::string& op) {
    if (op == "==") return a == b;
    if (op == "!=") return a != b;
    if (op == "<") return a < b;
    if (op == "<=") return a <= b;
    return op == ">" ? a > b : a >= b;
}

std::optional<bool> compare(const Value& value, const std::string& left, const std::string& op,
                            const std::string& right, Problems& problems) {
    const auto a = comparable(left), b = comparable(right);
    if (a && b) return ordered(*a, *b, op);
    if (op == "==") return left == right;
    if (op == "!=") return left != right;
    problems.add(value.mark, "E-WHEN",
                 fmt::format("'{}' compares numbers, found '{}' and '{}'", op, left, right),
                 "texts can be compared by == and !=");
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
    condition.known = true; // so that a condition with a problem hides nothing of what follows
    const auto found = value.is_scalar() ? find_operator(value.text) : std::nullopt;
    if (!found) {
        const Value is = resolved(value, scope, problems);
        if (is.deferred) return condition;
        if (const auto truth = is.as_bool()) return condition.known = truth, condition;
        problems.add(
            value.mark, "E-WHEN",
            fmt::format("expected true, false, a comparison or properties, found {}", is.described()),
            "when: \"${flag}\", when: ${quality} == high, or when: {closed: false}");
        return condition;
    }
    const auto side = [&](const std::string& text) {
        return resolved(Value::scalar(trimmed(text), value.mark), scope, problems);
    };
    const auto [at, op] = *found;
    const Value left = side(value.text.substr(0, at)), right = side(value.text.substr(at + op.size()));
    if (left.deferred || right.deferred) return condition;
    if (const auto truth = compare(value, left.text, op, right.text, problems)) condition.known = truth;
    return condition;
}

} // namespace facetmill::pipeline

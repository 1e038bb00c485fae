#include "stage/assertions.hpp"

#include "base/numbers.hpp"
#include "base/spelling.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

std::vector<std::string> property_names() {
    std::vector<std::string> names;
    for (const auto& p : property_table()) names.emplace_back(p.name);
    return names;
}

/// Whether the bound is of the property's kind: a truth for truths, a number or a range for numbers.
bool check_kind(const Property& property, const Bound& bound, const Value& value, Problems& problems) {
    if (value.deferred || property.truth == bound.truth.has_value()) return true;
    problems.add(value.mark, "E-TYPE",
                 fmt::format("'{}' is {}, found {}", property.name,
                             property.truth ? "true or false" : "a number (2) or a range ({min: 1, max: 5})",
                             value.described()));
    return false;
}

std::string finding(const Property& property, std::optional<double> value) {
    if (!value) return property.costly ? "not computed" : "not applicable";
    if (property.truth) return *value != 0 ? "true" : "false";
    return spelled(*value);
}

} // namespace

std::string expectation(const Bound& bound) {
    if (bound.truth) return *bound.truth ? "true" : "false";
    if (bound.min && bound.max && *bound.min == *bound.max) return spelled(*bound.min);
    if (bound.min && bound.max) return fmt::format("{} to {}", spelled(*bound.min), spelled(*bound.max));
    return bound.min ? fmt::format("at least {}", spelled(*bound.min))
                     : fmt::format("at most {}", spelled(bound.max.value_or(0)));
}

bool holds(const Bound& bound, double value) {
    if (bound.truth) return (value != 0) == *bound.truth;
    return (!bound.min || value >= *bound.min) && (!bound.max || value <= *bound.max);
}

InspectSettings Assertions::settings() const {
    InspectSettings settings;
    for (const auto& a : all) {
        const Property& property = *property_named(a.property);
        settings.self_intersections |= property.costly;
        if (property.quality) settings.qualities |= 1u << static_cast<unsigned>(*property.quality);
    }
    return settings;
}

bool parse_assertions(const Value& value, Assertions& out, std::string_view owner, Problems& problems,
                      const std::set<std::string>& also_known) {
    if (value.deferred) return true;
    if (!value.is_map()) {
        problems.add(value.mark, "E-TYPE",
                     fmt::format("{} takes a map of properties ({{closed: true}}), found {}", owner,
                                 value.described()));
        return false;
    }
    if (value.entries.empty() && also_known.empty()) {
        problems.add(value.mark, "E-TYPE", fmt::format("{} names no property", owner),
                     "for example {closed: true}");
        return false;
    }
    bool good = true;
    for (const auto& entry : value.entries) {
        if (also_known.contains(entry.key)) continue;
        const Property* property = property_named(entry.key);
        if (!property) {
            auto known = property_names();
            known.insert(known.end(), also_known.begin(), also_known.end());
            problems.add(entry.key_mark, "E-KEY", fmt::format("{} knows no property '{}'", owner, entry.key),
                         suggestion(entry.key, known));
            good = false;
            continue;
        }
        Assertion assertion{entry.key, {}, entry.key_mark};
        // A truth is told apart first, so that nobody hears of numbers who wrote `closed: maybe`.
        const bool no_truth = property->truth && !entry.value.deferred && !entry.value.as_bool();
        if (no_truth)
            good = check_kind(*property, {}, entry.value, problems);
        else if (OptionType<Bound>::parse(entry.value, assertion.bound, problems) &&
                 check_kind(*property, assertion.bound, entry.value, problems))
            out.all.push_back(std::move(assertion));
        else
            good = false;
    }
    return good;
}

Json assertions_schema() {
    Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
    const Json bound = OptionType<Bound>::schema();
    for (const auto& p : property_table()) {
        Json property = p.truth ? Json{{"type", "boolean"}} : bound;
        property["description"] = p.help;
        schema["properties"][std::string(p.name)] = std::move(property);
    }
    return schema;
}

std::vector<report::Check> evaluate(const Assertions& assertions, const Properties& properties,
                                    const std::string& stage) {
    std::vector<report::Check> checks;
    for (const auto& assertion : assertions.all) {
        const Property& property = *property_named(assertion.property);
        const auto value = property.get(properties);
        report::Check check;
        check.name = assertion.property;
        check.stage = stage;
        check.expected = expectation(assertion.bound);
        check.found = finding(property, value);
        check.passed = value ? holds(assertion.bound, *value) : assertion.if_applies;
        check.where = assertion.where;
        checks.push_back(std::move(check));
    }
    return checks;
}

} // namespace facetmill

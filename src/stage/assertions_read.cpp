// Reads the assertions of stage/assertions.hpp from user input.
#include "base/math/numbers.hpp"
#include "options/lists.hpp"
#include "stage/assertions.hpp"
#include "stage/options/convention.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill {

namespace {

const char* wanted(PropertyKind kind) {
    switch (kind) {
    case PropertyKind::truth:
        return "true or false";
    case PropertyKind::length:
        return "a length (2mm) or a range ({min: 1mm, max: 5%})";
    case PropertyKind::angle:
        return "an angle (30deg) or a range ({min: 5deg, max: 0.5rad})";
    case PropertyKind::box:
        return "a box ({min: [0, 0, 0], max: [20cm, 20cm, 5cm]})";
    case PropertyKind::count:
    case PropertyKind::number:
    case PropertyKind::area:
    case PropertyKind::volume:
    case PropertyKind::word:
        break;
    }
    return "a number (2) or a range ({min: 1, max: 5})";
}

bool wrong_kind(const Property& property, const Value& value, Problems& problems) {
    problems.add(
        value.mark, "E-TYPE",
        fmt::format("'{}' is {}, found {}", property.name, wanted(property.kind), value.described()));
    return false;
}

bool read_truth(const Property& property, const Value& value, Assertion& out, Problems& problems) {
    out.bound.truth = value.as_bool();
    return out.bound.truth || wrong_kind(property, value, problems);
}

/// True if some value of the property can satisfy the bound.
bool verify(const Property& property, const Value& value, const Bound& bound, Problems& problems) {
    const auto refuse = [&](std::string message, std::string hint) {
        problems.add(value.mark, "E-RANGE", std::move(message), std::move(hint));
        return false;
    };
    const auto broken = [](const std::optional<double>& x) { return x && *x != std::floor(*x); };
    if (property.kind == PropertyKind::count && (broken(bound.min) || broken(bound.max)))
        return refuse(fmt::format("'{}' is a count: a whole number", property.name), {});
    if (bound.max && *bound.max < property.lowest)
        return refuse(
            fmt::format("no mesh can have a '{}' of at most {}", property.name, to_string(*bound.max)),
            fmt::format("the lowest is {}", to_string(property.lowest)));
    if (bound.min && *bound.min > property.highest)
        return refuse(
            fmt::format("no mesh can have a '{}' of at least {}", property.name, to_string(*bound.min)),
            fmt::format("the highest is {}", to_string(property.highest)));
    return true;
}

bool read_number(const Property& property, const Value& value, Assertion& out, Problems& problems) {
    if (!value.is_map() && !value.is_scalar()) return wrong_kind(property, value, problems);
    if (value.as_bool()) return wrong_kind(property, value, problems);
    AngleBound angle;
    const bool good = property.kind == PropertyKind::angle
                          ? OptionType<AngleBound>::parse(value, angle, problems)
                          : OptionType<Bound>::parse(value, out.bound, problems);
    if (property.kind == PropertyKind::angle) out.bound = angle;
    return good && verify(property, value, out.bound, problems);
}

bool read_word(const Property& property, const Value& value, Assertion& out, Problems& problems) {
    Option option;
    option.name = property.name;
    option.choices = word_choices(property);
    const auto index = choice_index(option, value, problems);
    if (index) out.bound.min = out.bound.max = static_cast<double>(*index);
    return index.has_value();
}

/// Reads a length, or three lengths for a corner, as a list or in the one-liner's syntax "0,0,20cm".
bool read_lengths(const Value& value, std::size_t count, std::vector<Length>& out, std::vector<Mark>& marks,
                  Problems& problems) {
    if (count == 1) {
        marks.push_back(value.mark);
        return OptionType<Length>::parse(value, out.emplace_back(), problems);
    }
    const Value list = listed(value);
    if (!list.is_list() || list.items.size() != count) {
        problems.add(value.mark, "E-TYPE",
                     fmt::format("expected three lengths ([0, 0, 20cm]), found {}", value.described()));
        return false;
    }
    bool good = true;
    for (const Value& item : list.items) good &= read_lengths(item, 1, out, marks, problems);
    return good;
}

/// True if a number can be both at least min and at most max, as far as this is known without a scene.
bool may_hold(const Assertion& a) {
    for (std::size_t i = 0; i < std::min(a.min.size(), a.max.size()); ++i)
        if (a.min[i].kind == a.max[i].kind && a.min[i].of == a.max[i].of && a.min[i].amount > a.max[i].amount)
            return false;
    return true;
}

bool verify_length(const Property& property, const Value& value, const Assertion& a, Problems& problems) {
    if (a.max.empty() || a.max[0].amount >= 0) return true;
    problems.add(value.mark, "E-RANGE",
                 fmt::format("no mesh can have a '{}' of at most {}", property.name, a.max[0].text),
                 "the lowest is 0");
    return false;
}

bool read_length_range(const Property& property, const Value& value, Assertion& out, Problems& problems) {
    const std::size_t count = property.kind == PropertyKind::box ? 3 : 1;
    if (value.deferred) return true;
    if (!value.is_map()) {
        if (count == 3 || !value.is_scalar() || value.as_bool()) return wrong_kind(property, value, problems);
        const bool good = read_lengths(value, 1, out.min, out.min_at, problems);
        out.max = out.min;
        out.max_at = out.min_at;
        return good && verify_length(property, value, out, problems);
    }
    bool good = true;
    for (const auto& e : value.entries) {
        if (e.key != "min" && e.key != "max") {
            problems.add(e.key_mark, "E-KEY", fmt::format("a bound has no key '{}'", e.key),
                         "expected min or max");
            good = false;
        } else if (!e.value.deferred)
            good &= e.key == "min" ? read_lengths(e.value, count, out.min, out.min_at, problems)
                                   : read_lengths(e.value, count, out.max, out.max_at, problems);
    }
    if (good && value.entries.empty()) return wrong_kind(property, value, problems);
    if (good && count == 1 && !verify_length(property, value, out, problems)) return false;
    if (good && !may_hold(out)) {
        problems.add(value.mark, "E-RANGE", "min is larger than max, so no length is in the range",
                     "exchange min and max");
        return false;
    }
    return good;
}

bool read(const Property& property, const Value& value, Assertion& out, Problems& problems) {
    if (value.deferred) return true;
    switch (property.kind) {
    case PropertyKind::truth:
        return read_truth(property, value, out, problems);
    case PropertyKind::word:
        return read_word(property, value, out, problems);
    case PropertyKind::length:
    case PropertyKind::box:
        return read_length_range(property, value, out, problems);
    case PropertyKind::count:
    case PropertyKind::number:
    case PropertyKind::angle:
    case PropertyKind::area:
    case PropertyKind::volume:
        break;
    }
    return read_number(property, value, out, problems);
}

Json range_schema(const Json& limit) {
    return {{"type", "object"},
            {"additionalProperties", false},
            {"minProperties", 1},
            {"properties", {{"min", limit}, {"max", limit}}}};
}

Json schema_of(const Property& property) {
    const Json length = OptionType<Length>::schema();
    switch (property.kind) {
    case PropertyKind::truth:
        return {{"type", "boolean"}};
    case PropertyKind::word:
        return choice_schema(word_choices(property));
    case PropertyKind::length:
        return {{"anyOf", Json::array({length, range_schema(length)})}};
    case PropertyKind::box:
        return range_schema({{"type", "array"}, {"items", length}, {"minItems", 3}, {"maxItems", 3}});
    case PropertyKind::angle:
        return OptionType<AngleBound>::schema();
    case PropertyKind::count:
    case PropertyKind::number:
    case PropertyKind::area:
    case PropertyKind::volume:
        break;
    }
    return OptionType<Bound>::schema();
}

/// The position of min or max, if only one of them is given.
Mark place_of(const Value& bound, const Mark& otherwise) {
    const Value& one = bound.is_map() && bound.entries.size() == 1 ? bound.entries[0].value : bound;
    return one.mark.known() ? one.mark : otherwise;
}

} // namespace

bool parse_assertions(const Value& value, Assertions& out, std::string_view owner, Problems& problems,
                      const std::set<std::string>& also_known) {
    if (value.deferred) return true;
    if (!value.is_map()) {
        problems.add(value.mark, "E-TYPE",
                     fmt::format("{} needs a map of properties ({{closed: true}}), found {}", owner,
                                 value.described()));
        return false;
    }
    verify_any(!value.entries.empty(), value, owner, problems);
    bool good = !value.entries.empty();
    for (const auto& entry : value.entries) {
        if (also_known.contains(entry.key)) continue;
        const Property* property = property_named(entry.key);
        if (!property) {
            auto known = known_properties();
            for (const auto& name : also_known) known.push_back({name});
            problems.add(entry.key_mark, "E-KEY", fmt::format("{} has no property '{}'", owner, entry.key),
                         hint_for_option(entry.key, known, "facetmill stages validate lists the properties"));
            good = false;
            continue;
        }
        Assertion assertion{.property = entry.key, .where = place_of(entry.value, entry.key_mark)};
        if (read(*property, entry.value, assertion, problems))
            out.all.push_back(std::move(assertion));
        else
            good = false;
    }
    return good;
}

void verify_any(bool any, const Value& given, std::string_view owner, Problems& problems) {
    if (any || given.deferred) return;
    problems.add(given.mark, "E-MISSING", fmt::format("{} needs at least one property", owner),
                 fmt::format("{}: {{closed: true}}", owner));
}

std::vector<Choice> word_choices(const Property& property) {
    std::vector<Choice> choices;
    const auto add = [&](const auto& named) {
        for (const auto& c : named) choices.push_back({c.name, c.help});
    };
    if (std::holds_alternative<std::optional<Unit> Properties::*>(property.member))
        add(unit_choices(to_string(Unit::unknown), "not known"));
    if (std::holds_alternative<std::optional<UpAxis> Properties::*>(property.member))
        add(up_choices(to_string(UpAxis::unknown), "not known"));
    return choices;
}

std::string help_of(const Property& property) {
    std::string help(property.help);
    const bool told = property.kind == PropertyKind::length || property.kind == PropertyKind::box;
    const auto unit = unit_of(property.kind);
    return told || unit.empty() ? help : fmt::format("{} In {}.", help, unit);
}

Json assertions_schema() {
    Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", Json::object()}};
    for (const auto& p : property_table()) {
        Json property = schema_of(p);
        property["description"] = help_of(p);
        schema["properties"][std::string(p.name)] = std::move(property);
    }
    return schema;
}

} // namespace facetmill

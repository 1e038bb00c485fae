#include "stage/assertions.hpp"

#include "base/math/numbers.hpp"
#include "base/text/plain_number.hpp"
#include "base/text/words.hpp"
#include "report/render.hpp"
#include "stage/context.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

std::string written(const std::vector<Length>& lengths) {
    if (lengths.size() == 1) return lengths[0].text;
    std::string text;
    for (const Length& l : lengths) append_item(text, l.text);
    return "[" + text + "]";
}

bool same(const std::vector<Length>& a, const std::vector<Length>& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                              [](const auto& x, const auto& y) { return x.text == y.text; });
}

/// The lengths as written, with their values in the scene if these differ: "10mm (0.01)".
std::string told(const std::vector<Length>& lengths, const std::vector<double>& are) {
    const bool plain = std::all_of(lengths.begin(), lengths.end(),
                                   [](const Length& l) { return l.kind == Length::Kind::scene; });
    if (plain) return written(lengths);
    std::string text;
    for (const double x : are) append_item(text, fmt::format("{:.6g}", x));
    return fmt::format("{} ({})", written(lengths), text);
}

std::vector<double> numbers(const Vec3& p) { return {p.x, p.y, p.z}; }

std::string expectation(const Property& property, const Assertion& a) {
    if (property.kind == PropertyKind::word)
        return std::string(property.words()[static_cast<std::size_t>(a.bound.min.value_or(0))]);
    if (property.kind == PropertyKind::box) {
        std::string text = a.min.empty() ? "" : "at least " + told(a.min, numbers(a.within.min));
        if (!a.max.empty()) append_item(text, "at most " + told(a.max, numbers(a.within.max)));
        return text;
    }
    if (a.min.empty() && a.max.empty()) return expectation(a.bound);
    const auto least = [&] { return told(a.min, {a.bound.min.value_or(0)}); };
    const auto most = [&] { return told(a.max, {a.bound.max.value_or(0)}); };
    if (same(a.min, a.max)) return least();
    if (a.min.empty()) return "at most " + most();
    return a.max.empty() ? "at least " + least() : least() + " to " + most();
}

bool lies_within(const Box& inner, const Box& outer) {
    for (std::size_t i = 0; i < 3; ++i)
        if (!(inner.min[i] >= outer.min[i] && inner.max[i] <= outer.max[i])) return false;
    return true;
}

} // namespace

std::string expectation(const Bound& bound) {
    if (bound.truth) return *bound.truth ? "true" : "false";
    if (bound.min && bound.max && *bound.min == *bound.max) return plain_number(*bound.min);
    if (bound.min && bound.max)
        return fmt::format("{} to {}", plain_number(*bound.min), plain_number(*bound.max));
    return bound.min ? fmt::format("at least {}", plain_number(*bound.min))
                     : fmt::format("at most {}", plain_number(bound.max.value_or(0)));
}

bool holds(const Bound& bound, double value) {
    if (bound.truth) return (value != 0) == *bound.truth;
    return (!bound.min || value >= *bound.min) && (!bound.max || value <= *bound.max);
}

std::string to_string(const Assertion& a) {
    const Property& property = *property_named(a.property);
    if (property.kind == PropertyKind::word) return a.bound.min ? expectation(property, a) : "";
    if (a.min.empty() && a.max.empty()) return OptionType<Bound>::print(a.bound);
    if (same(a.min, a.max)) return written(a.min);
    std::string text = a.min.empty() ? "" : "min: " + written(a.min);
    if (!a.max.empty()) append_item(text, "max: " + written(a.max));
    return "{" + text + "}";
}

InspectSettings Assertions::settings() const {
    InspectSettings settings;
    for (const auto& a : all) settings.request(*property_named(a.property));
    return settings;
}

std::vector<Assertions::PhysicalLength> Assertions::physical() const {
    std::vector<PhysicalLength> found;
    const auto add = [&](const Assertion& a, const std::vector<Length>& lengths,
                         const std::vector<Mark>& marks) {
        for (std::size_t i = 0; i < lengths.size(); ++i)
            if (lengths[i].kind == Length::Kind::physical)
                found.push_back({a.property, &lengths[i], i < marks.size() ? marks[i] : a.where});
    };
    for (const auto& a : all) {
        add(a, a.min, a.min_at);
        add(a, a.max, a.max_at);
    }
    return found;
}

Assertions resolved(Assertions assertions, const Scene& scene, Context& context) {
    for (auto& a : assertions.all) {
        const auto number = [&](const Length& l) { return context.resolve(l, scene, a.property); };
        if (property_named(a.property)->kind == PropertyKind::box) {
            a.within = {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}};
            for (std::size_t i = 0; i < a.min.size(); ++i) a.within.min[i] = number(a.min[i]);
            for (std::size_t i = 0; i < a.max.size(); ++i) a.within.max[i] = number(a.max[i]);
            continue;
        }
        if (!a.min.empty()) a.bound.min = number(a.min[0]);
        if (!a.max.empty()) a.bound.max = number(a.max[0]);
    }
    return assertions;
}

std::optional<bool> holds(const Assertion& assertion, const Properties& properties) {
    const Property& property = *property_named(assertion.property);
    if (property.kind == PropertyKind::box) {
        if (properties.bounds.empty()) return {};
        return lies_within(properties.bounds, assertion.within);
    }
    const auto value = property.get(properties);
    if (!value) return {};
    return holds(assertion.bound, *value);
}

namespace {
/// Hints for minima apply to values that are too small, hints for maxima to values that are too large.
bool hint_fits(const Property& property, const Bound& bound, const Properties& properties) {
    if (property.join != Join::least && property.join != Join::most) return true;
    const auto value = property.get(properties);
    if (!value) return true;
    return property.join == Join::least ? !(bound.max && *value > *bound.max)
                                        : !(bound.min && *value < *bound.min);
}

/// True if the scene is empty or has only points, and the property needs faces or lines, or counts points. No
/// stage can help then.
bool lacks_faces(const Property& property, const Properties& properties) {
    return properties.faces == 0 && properties.lines == 0 && !property.of_scene() &&
           property.kind != PropertyKind::box && (property.of_faces || !property.measure);
}

/// True if a measured property must equal a number. This is rarely intended, unless the number is 0.
bool asks_exactly(const Property& property, const Bound& bound) {
    using enum PropertyKind;
    const bool measured = property.kind == number || property.kind == angle || property.kind == length ||
                          property.kind == area || property.kind == volume;
    return measured && bound.min && bound.max && *bound.min == *bound.max && *bound.min != 0;
}
} // namespace

std::vector<report::Check> evaluate(const Assertions& assertions, const Properties& properties,
                                    const std::string& stage) {
    std::vector<report::Check> checks;
    for (const auto& assertion : assertions.all) {
        const Property& property = *property_named(assertion.property);
        report::Check check;
        check.name = assertion.property;
        check.stage = stage;
        check.expected = expectation(property, assertion);
        check.found = report::property_value(property, properties);
        if (check.found.index() == 0 && property.costly) check.found_words = "not computed";
        if (!property.truth()) {
            check.min = assertion.bound.min;
            check.max = assertion.bound.max;
        }
        check.passed = holds(assertion, properties).value_or(assertion.if_applies);
        if (!check.passed && asks_exactly(property, assertion.bound))
            check.hint = "a bare value requires exactly this value; use min for at least, max for at most";
        else if (!check.passed && lacks_faces(property, properties))
            check.hint = properties.vertices > 0
                             ? "the scene has points but no faces, and most checks and stages need faces"
                             : "no faces are left; run with -v to see which stage removed the last faces";
        else if (!check.passed && hint_fits(property, assertion.bound, properties))
            check.hint = property.hint;
        check.where = assertion.where;
        checks.push_back(std::move(check));
    }
    return checks;
}

} // namespace facetmill

#include "options/types.hpp"

#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "base/text/spelling.hpp"
#include "options/lists.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace facetmill {

namespace {

constexpr std::array<std::pair<std::string_view, double>, 8> length_units{{{"um", 1e-6},
                                                                           {"mm", 1e-3},
                                                                           {"cm", 1e-2},
                                                                           {"m", 1.0},
                                                                           {"km", 1e3},
                                                                           {"in", 0.0254},
                                                                           {"ft", 0.3048},
                                                                           {"inch", 0.0254}}};

/// A hint for a param written in the syntax of other languages: {keep}, $keep, {{keep}}.
std::string hint_of_foreign_expression(std::string_view text) {
    const auto is_sign = [](char c) { return c == '$' || c == '{' || c == '}' || c == ' '; };
    if (text.empty() || (text[0] != '$' && text[0] != '{')) return {};
    while (!text.empty() && is_sign(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_sign(text.back())) text.remove_suffix(1);
    const bool name = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-' || c == '.';
    });
    return name ? fmt::format("write the value of a param as ${{{}}}", text) : "";
}

} // namespace

bool wrong_type(const Value& value, std::string_view expected, Problems& problems, std::string hint) {
    if (hint.empty() && value.is_scalar()) hint = hint_of_foreign_expression(value.text);
    if (hint.empty() && value.is_scalar() && value.quoted) hint = "remove the quotes";
    problems.add(value.mark, "E-TYPE", fmt::format("expected {}, found {}", expected, value.described()),
                 std::move(hint));
    return false;
}

std::optional<std::pair<double, std::string_view>> number_and_unit(std::string_view text) {
    std::size_t split = text.size();
    while (split > 0 && !(text[split - 1] >= '0' && text[split - 1] <= '9') && text[split - 1] != '.')
        --split;
    const auto number = parse_real(text.substr(0, split));
    if (!number) return {};
    std::string_view unit = text.substr(split);
    while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
    return std::pair{*number, unit};
}

// --- bool, numbers, text

namespace {

/// The hint "write true" for words that other YAML versions treat as truths.
std::string hint_of_truth(const Value& value) {
    const std::string word = value.is_scalar() ? lower_case(value.text) : "";
    if (word == "yes" || word == "on" || word == "y") return "write true";
    return word == "no" || word == "off" || word == "n" ? "write false" : "";
}

/// The intended integer: 20000 for 20k and 20,000.
std::optional<std::int64_t> integer_meant(const Value& value) {
    if (!value.is_scalar()) return {};
    std::string digits = value.text;
    std::erase_if(digits, [](char c) { return c == ',' || c == '_' || c == '\''; });
    const auto parts = number_and_unit(digits);
    if (!parts) return {};
    const std::string_view unit = parts->second;
    const double factor = unit.empty()                 ? 1
                          : unit == "k" || unit == "K" ? 1e3
                          : unit == "m" || unit == "M" ? 1e6
                                                       : 0;
    const double number = parts->first * factor;
    constexpr double most = 1e15; // exact in a double, with a margin
    if (factor == 0 || number != std::floor(number) || std::abs(number) > most) return {};
    return static_cast<std::int64_t>(number);
}

std::string hint_of_integer(const Value& value) {
    const auto meant = integer_meant(value);
    return meant ? fmt::format("write {}", *meant) : "";
}

/// A hint with the replacement for 10% or 2mm; empty for other values.
std::string hint_of_number(const Value& value) {
    const auto parts = value.is_scalar() ? number_and_unit(value.text) : std::nullopt;
    if (!parts) return {};
    const double number = parts->first;
    const std::string_view unit = parts->second;
    if (unit == "%" || unit == "pct") return fmt::format("write {}", to_string(number / 100));
    const bool length =
        std::any_of(length_units.begin(), length_units.end(), [&](const auto& u) { return u.first == unit; });
    if (!length) return {};
    return fmt::format(
        "the number has no unit here: write {}; transform: {{unit: {}}} converts a scene to a unit",
        to_string(number), unit);
}

} // namespace

std::string_view to_string(OptionKind kind) {
    switch (kind) {
    case OptionKind::boolean:
        return "bool";
    case OptionKind::integer:
        return "integer";
    case OptionKind::number:
        return "number";
    case OptionKind::text:
        return "text";
    case OptionKind::path:
        return "path";
    case OptionKind::ratio:
        return "ratio";
    case OptionKind::length:
        return "length";
    case OptionKind::angle:
        return "angle";
    case OptionKind::vector:
        return "vector";
    case OptionKind::bound:
        return "bound";
    case OptionKind::limit:
        return "limit";
    case OptionKind::choice:
        return "choice";
    case OptionKind::group:
        return "group";
    case OptionKind::list:
        return "list";
    case OptionKind::assertions:
        return "assertions";
    case OptionKind::rows:
        return "rows";
    case OptionKind::footprint:
        return "footprint";
    case OptionKind::range:
        return "range";
    case OptionKind::point:
        return "point";
    case OptionKind::coefficients:
        return "coefficients";
    case OptionKind::plane:
        return "plane";
    case OptionKind::corners:
        return "corners";
    }
    return {};
}

bool may_be_map(OptionKind kind) {
    using enum OptionKind;
    return kind == bound || kind == limit || kind == group || kind == assertions || kind == plane;
}

bool may_be_list(OptionKind kind) {
    using enum OptionKind;
    return kind == vector || kind == list || kind == rows || kind == footprint || kind == range ||
           kind == point || kind == coefficients || kind == plane || kind == corners;
}

bool OptionType<bool>::parse(const Value& value, bool& out, Problems& problems) {
    if (value.deferred) return true;
    const auto truth = value.as_bool();
    if (!truth) return wrong_type(value, "true or false", problems, hint_of_truth(value));
    out = *truth;
    return true;
}
std::string OptionType<bool>::print(const bool& value) { return value ? "true" : "false"; }
Json OptionType<bool>::schema() { return {{"type", "boolean"}}; }
std::optional<double> OptionType<bool>::magnitude(const bool&) { return {}; }

bool OptionType<std::int64_t>::parse(const Value& value, std::int64_t& out, Problems& problems) {
    if (value.deferred) return true;
    const auto number = value.as_integer();
    if (!number) return wrong_type(value, "an integer", problems, hint_of_integer(value));
    out = *number;
    return true;
}
std::string OptionType<std::int64_t>::print(const std::int64_t& value) { return fmt::format("{}", value); }
Json OptionType<std::int64_t>::schema() { return {{"type", "integer"}}; }
std::optional<double> OptionType<std::int64_t>::magnitude(const std::int64_t& v) {
    return static_cast<double>(v);
}

bool OptionType<double>::parse(const Value& value, double& out, Problems& problems) {
    if (value.deferred) return true;
    const auto number = value.as_real();
    if (!number) return wrong_type(value, "a finite number", problems, hint_of_number(value));
    out = *number;
    return true;
}
std::string OptionType<double>::print(const double& value) { return to_string(value); }
Json OptionType<double>::schema() { return {{"type", "number"}}; }
std::optional<double> OptionType<double>::magnitude(const double& value) { return value; }

bool OptionType<std::string>::parse(const Value& value, std::string& out, Problems& problems) {
    if (value.deferred) return true;
    if (!value.is_scalar()) return wrong_type(value, "a text", problems);
    out = value.text;
    return true;
}
std::string OptionType<std::string>::print(const std::string& value) { return value; }
Json OptionType<std::string>::schema() { return {{"type", Json::array({"string", "number", "boolean"})}}; }
std::optional<double> OptionType<std::string>::magnitude(const std::string&) { return {}; }

bool OptionType<PathText>::parse(const Value& value, PathText& out, Problems& problems) {
    if (value.deferred) return true;
    if (!value.is_scalar() || value.text.empty()) return wrong_type(value, "a path", problems);
    if (value.text.find('\0') != std::string::npos) return wrong_type(value, "a path without NUL", problems);
    out.text = value.text;
    return true;
}
std::string OptionType<PathText>::print(const PathText& value) { return value.text; }
Json OptionType<PathText>::schema() { return {{"type", "string"}, {"minLength", 1}}; }
std::optional<double> OptionType<PathText>::magnitude(const PathText&) { return {}; }

// --- quantities

bool OptionType<Ratio>::parse(const Value& value, Ratio& out, Problems& problems) {
    if (value.deferred) return true;
    const std::string expected = "a ratio (25% or 0.25)";
    if (!value.is_scalar()) return wrong_type(value, expected, problems);
    const auto parts = number_and_unit(value.text);
    if (!parts || !(parts->second == "%" || parts->second == "pct" || parts->second.empty())) {
        const auto count = integer_meant(value); // accepts, for example, 10k
        return wrong_type(value, expected, problems,
                          count ? fmt::format("name the option for a count (faces: {})", *count) : "");
    }
    const bool percent = !parts->second.empty();
    const bool whole = value.text.find('.') == std::string::npos && parts->first == std::floor(parts->first);
    if (!percent && whole && parts->first != 0) { // 5e-1 is not a ratio
        const auto hint =
            parts->first < 0 ? "a ratio cannot be negative"
            : parts->first <= 100
                ? fmt::format("write {}%, or name the option for a count (faces: {})",
                              parts->first == 1 ? "100" : value.text, value.text)
                : fmt::format("a ratio needs a point or a % (50%); for a count write faces: {}", value.text);
        return wrong_type(value, expected, problems, hint);
    }
    out.value = percent ? parts->first / 100 : parts->first;
    return true;
}
std::string OptionType<Ratio>::print(const Ratio& value) { return to_string(value.value * 100) + "%"; }
/// A schema treats 1 and 1.0 as the same number, and 1 is refused above. The whole is written 100%.
Json OptionType<Ratio>::schema() {
    return {{"anyOf", Json::array({{{"type", "number"}, {"minimum", 0}, {"exclusiveMaximum", 1}},
                                   {{"type", "string"}, {"pattern", "^[0-9.eE+-]+ *(%|pct)$"}}})}};
}
std::optional<double> OptionType<Ratio>::magnitude(const Ratio& value) { return value.value; }

Length Length::scene(double amount) { return {amount, Kind::scene, Of::stage, to_string(amount)}; }
Length Length::percent(double amount, Of of) {
    const char* basis = of == Of::part ? " of part" : of == Of::load ? " of load" : "";
    return {amount, Kind::percent, of, to_string(amount) + "%" + basis};
}

bool OptionType<Length>::parse(const Value& value, Length& out, Problems& problems) {
    if (value.deferred) return true;
    const std::string expected = "a length (2, 2mm, 0.5%, 0.5% of part)";
    if (!value.is_scalar()) return wrong_type(value, expected, problems);
    const auto parts = number_and_unit(value.text);
    if (!parts) return wrong_type(value, expected, problems);
    const auto [number, unit] = *parts;
    out = {number, Length::Kind::scene, Length::Of::stage, value.text};
    if (unit.empty()) return true;
    for (const std::string_view percent : {"%", "pct"}) {
        if (!unit.starts_with(percent)) continue;
        const auto basis = unit.substr(percent.size());
        out.kind = Length::Kind::percent;
        if (basis.empty()) return true;
        if (basis == " of part") {
            out.of = Length::Of::part;
            return true;
        }
        if (basis == " of load") {
            out.of = Length::Of::load;
            return true;
        }
        return wrong_type(value, expected, problems);
    }
    for (const auto& [name, metres] : length_units)
        if (unit == name) {
            out.kind = Length::Kind::physical;
            out.amount = number * metres;
            return true;
        }
    return wrong_type(value, expected, problems, "units: um, mm, cm, m, km, in, ft, or %");
}
std::string OptionType<Length>::print(const Length& value) { return value.text.empty() ? "0" : value.text; }
Json OptionType<Length>::schema() {
    return {{"anyOf",
             Json::array(
                 {{{"type", "number"}},
                  {{"type", "string"},
                   {"pattern", "^[0-9.eE+-]+ *(um|mm|cm|m|km|in|inch|ft|(%|pct)( of (part|load))?)?$"}}})}};
}
std::optional<double> OptionType<Length>::magnitude(const Length& value) { return value.amount; }

Angle Angle::degrees(double d) { return {d * (pi / 180), to_string(d) + "deg"}; }

bool OptionType<Angle>::parse(const Value& value, Angle& out, Problems& problems) {
    if (value.deferred) return true;
    const std::string expected = "an angle (30deg, 0.5rad; a bare number is degrees)";
    const auto parts = value.is_scalar() ? number_and_unit(value.text) : std::nullopt;
    if (!parts || !(parts->second.empty() || parts->second == "deg" || parts->second == "rad"))
        return wrong_type(value, expected, problems);
    out.radians = parts->second == "rad" ? parts->first : parts->first * (pi / 180);
    out.text = value.text;
    return true;
}
std::string OptionType<Angle>::print(const Angle& value) { return value.text; }
Json OptionType<Angle>::schema() {
    return {{"anyOf", Json::array({{{"type", "number"}},
                                   {{"type", "string"}, {"pattern", "^[0-9.eE+-]+ *(deg|rad)?$"}}})}};
}
/// The angle in degrees, because ranges of angles are declared in degrees.
std::optional<double> OptionType<Angle>::magnitude(const Angle& value) { return value.radians * (180 / pi); }

bool OptionType<Vec3>::parse(const Value& value, Vec3& out, Problems& problems) {
    if (value.deferred) return true;
    const std::string expected = "three numbers ([0, 0, 1])";
    const Value list = listed(value); // "0,0,1", as the one-liner writes it
    if (!list.is_list() || list.items.size() != 3) return wrong_type(value, expected, problems);
    bool good = true;
    for (std::size_t i = 0; i < 3; ++i) good &= OptionType<double>::parse(list.items[i], out[i], problems);
    return good;
}
std::string OptionType<Vec3>::print(const Vec3& v) {
    return fmt::format("[{}, {}, {}]", to_string(v.x), to_string(v.y), to_string(v.z));
}
Json OptionType<Vec3>::schema() {
    return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 3}, {"maxItems", 3}};
}
std::optional<double> OptionType<Vec3>::magnitude(const Vec3&) { return {}; }

} // namespace facetmill

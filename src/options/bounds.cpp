// Implements bounds and limits of options/types.hpp.
#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "options/byte_count.hpp"
#include "options/types.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill {

namespace {

using Limit = std::optional<double>;

bool read_number(const Value& value, Limit& out, Problems& problems) {
    if (value.deferred) return true;
    out = value.as_real();
    return out || wrong_type(value, "a number", problems);
}

bool read_angle(const Value& value, Limit& out, Problems& problems) {
    if (value.deferred) return true;
    Angle angle;
    if (!OptionType<Angle>::parse(value, angle, problems)) return false;
    // Keeps the text's number if it is in degrees: converting to radians and back would round it.
    const auto parts = number_and_unit(value.text);
    out = parts->second == "rad" ? angle.radians * (180 / pi) : parts->first;
    return true;
}

bool read_count(const Value& value, Limit& out, Problems& problems) {
    if (value.deferred) return true;
    const auto number = value.as_real();
    if (!number || *number != std::floor(*number) || *number < 0)
        return wrong_type(value, "a count (0, 1, 2 ...)", problems);
    out = number;
    return true;
}

bool read_bytes(const Value& value, Limit& out, Problems& problems) {
    if (value.deferred) return true;
    out = read_byte_count(value, problems);
    return out.has_value();
}

using Reader = bool (*)(const Value&, Limit&, Problems&);

bool read_range(const Value& value, Bound& out, Reader read, Problems& problems) {
    bool good = true;
    for (const auto& e : value.entries) {
        if (e.key == "min")
            good &= read(e.value, out.min, problems);
        else if (e.key == "max")
            good &= read(e.value, out.max, problems);
        else {
            problems.add(e.key_mark, "E-KEY", fmt::format("a bound has no key '{}'", e.key),
                         "expected min or max");
            good = false;
        }
    }
    if (out.min && out.max && *out.min > *out.max) {
        problems.add(
            value.mark, "E-RANGE",
            fmt::format("no number is at least {} and at most {}", to_string(*out.min), to_string(*out.max)),
            "swap min and max");
        good = false;
    }
    return good && (!value.entries.empty() || wrong_type(value, "min or max", problems));
}

/// A bare value is the required value or, for a limit, the maximum.
bool read_bound(const Value& value, Bound& out, Reader read, bool is_limit, Problems& problems) {
    out = {};
    if (value.deferred) return true;
    if (value.is_map()) return read_range(value, out, read, problems);
    if (!value.is_scalar()) return wrong_type(value, "a bound (2, {min: 1, max: 5})", problems);
    if (!read(value, out.max, problems)) return false;
    if (!is_limit) out.min = out.max;
    return true;
}

Json bound_schema(const Json& limit) {
    return {{"anyOf", Json::array({limit,
                                   {{"type", "object"},
                                    {"additionalProperties", false},
                                    {"minProperties", 1},
                                    {"properties", {{"min", limit}, {"max", limit}}}}})}};
}

std::string print_limit(const Bound& b) {
    if (b.max && !b.min) return to_string(*b.max);
    if (b.min && b.max) return fmt::format("{{min: {}, max: {}}}", to_string(*b.min), to_string(*b.max));
    return OptionType<Bound>::print(b);
}

} // namespace

bool OptionType<Bound>::parse(const Value& value, Bound& out, Problems& problems) {
    return read_bound(value, out, read_number, false, problems);
}
std::string OptionType<Bound>::print(const Bound& b) {
    if (b.truth) return *b.truth ? "true" : "false";
    if (b.min && b.max && *b.min == *b.max) return to_string(*b.min);
    if (b.min && b.max) return fmt::format("{{min: {}, max: {}}}", to_string(*b.min), to_string(*b.max));
    if (b.min) return fmt::format("{{min: {}}}", to_string(*b.min));
    return b.max ? fmt::format("{{max: {}}}", to_string(*b.max)) : "";
}
Json OptionType<Bound>::schema() { return bound_schema({{"type", "number"}}); }
std::optional<double> OptionType<Bound>::magnitude(const Bound&) { return {}; }

bool OptionType<AngleBound>::parse(const Value& value, AngleBound& out, Problems& problems) {
    return read_bound(value, out, read_angle, false, problems);
}
std::string OptionType<AngleBound>::print(const AngleBound& b) { return OptionType<Bound>::print(b); }
Json OptionType<AngleBound>::schema() { return bound_schema(OptionType<Angle>::schema()); }
std::optional<double> OptionType<AngleBound>::magnitude(const AngleBound&) { return {}; }

bool OptionType<CountLimit>::parse(const Value& value, CountLimit& out, Problems& problems) {
    return read_bound(value, out, read_count, true, problems);
}
std::string OptionType<CountLimit>::print(const CountLimit& b) { return print_limit(b); }
Json OptionType<CountLimit>::schema() { return bound_schema({{"type", "integer"}, {"minimum", 0}}); }
std::optional<double> OptionType<CountLimit>::magnitude(const CountLimit&) { return {}; }

bool OptionType<ByteLimit>::parse(const Value& value, ByteLimit& out, Problems& problems) {
    return read_bound(value, out, read_bytes, true, problems);
}
std::string OptionType<ByteLimit>::print(const ByteLimit& b) { return print_limit(b); }
Json OptionType<ByteLimit>::schema() {
    return bound_schema(
        {{"anyOf", Json::array({{{"type", "integer"}, {"minimum", 0}},
                                {{"type", "string"},
                                 {"pattern", "^[0-9.eE+]+ *(B|[kMGT]B|[KMGT]iB|[kKmMgGtT])$"}}})}});
}
std::optional<double> OptionType<ByteLimit>::magnitude(const ByteLimit&) { return {}; }

} // namespace facetmill

#pragma once
// Reads each C++ type of an option from a Value, prints it, and describes it. To add a type, specialise
// OptionType for it: the YAML parser, the one-liner, help, man page and schema follow.

#include "base/json.hpp"
#include "base/text/words.hpp"
#include "options/quantities.hpp"
#include "options/value.hpp"

#include <vector>

namespace facetmill {

/// The kind of an option's value.
enum class OptionKind {
    boolean,
    integer,
    number,
    text,
    path,
    ratio,
    length,
    angle,
    vector,
    bound,
    limit,
    choice,
    group,
    list,
    assertions,
    rows,
    footprint,
    range,
    point,
    coefficients,
    plane,
    corners
};
/// The name in help and the manual: "bool", "integer".
[[nodiscard]] std::string_view to_string(OptionKind kind);
/// Whether a value may be a map, or a list, in YAML. (For a group, its declaration decides.)
bool may_be_map(OptionKind kind);
bool may_be_list(OptionKind kind);

/// The dimension of an option's number.
enum class Dimension { none, length, angle, ratio, count, bytes };

/// Limits of a numeric option; the open ends are exclusive.
struct Range {
    std::optional<double> min, max;
    bool min_open = false, max_open = false;

    bool holds(double x) const;
    std::string to_string() const; ///< "0 < x <= 1", or empty
};

/// Splits "2.5mm" into 2.5 and "mm". None if it does not start with a number.
[[nodiscard]] std::optional<std::pair<double, std::string_view>> number_and_unit(std::string_view text);
/// Adds E-TYPE ("expected ..., found ...") at the value, and returns false.
bool wrong_type(const Value& value, std::string_view expected, Problems& problems, std::string hint = {});

/// Each specialisation has:
///   static constexpr OptionKind kind;
///   static constexpr Dimension dimension;
///   static bool parse(const Value&, T&, Problems&);         false after adding a problem at the value's mark
///   static std::string print(const T&);                     a spelling that parses to the same
///   static Json schema();                                   JSON Schema of what parse accepts
///   static std::optional<double> magnitude(const T&);       the number that a Range limits, if any
template <class T>
struct OptionType;

#define FACETMILL_OPTION_TYPE(T, KIND, DIMENSION)                                                            \
    template <>                                                                                              \
    struct OptionType<T> {                                                                                   \
        static constexpr OptionKind kind = OptionKind::KIND;                                                 \
        static constexpr Dimension dimension = DIMENSION;                                                    \
        static bool parse(const Value& value, T& out, Problems& problems);                                   \
        static std::string print(const T& value);                                                            \
        static Json schema();                                                                                \
        static std::optional<double> magnitude(const T& value);                                              \
    }

FACETMILL_OPTION_TYPE(bool, boolean, Dimension::none);
FACETMILL_OPTION_TYPE(std::int64_t, integer, Dimension::count);
FACETMILL_OPTION_TYPE(double, number, Dimension::none);
FACETMILL_OPTION_TYPE(std::string, text, Dimension::none);
FACETMILL_OPTION_TYPE(PathText, path, Dimension::none);
FACETMILL_OPTION_TYPE(Ratio, ratio, Dimension::ratio);
FACETMILL_OPTION_TYPE(Length, length, Dimension::length);
FACETMILL_OPTION_TYPE(Angle, angle, Dimension::angle);
FACETMILL_OPTION_TYPE(Vec3, vector, Dimension::none);
FACETMILL_OPTION_TYPE(Bound, bound, Dimension::none);
FACETMILL_OPTION_TYPE(AngleBound, bound, Dimension::angle);
FACETMILL_OPTION_TYPE(CountLimit, limit, Dimension::count);
FACETMILL_OPTION_TYPE(ByteLimit, limit, Dimension::bytes);

/// A single value or a list of values.
template <class T>
struct OptionType<std::vector<T>> {
    static constexpr OptionKind kind = OptionKind::list;
    static constexpr Dimension dimension = OptionType<T>::dimension;
    static bool parse(const Value& value, std::vector<T>& out, Problems& problems) {
        out.clear();
        if (value.is_list()) {
            bool good = true;
            for (const auto& item : value.items)
                good &= OptionType<T>::parse(item, out.emplace_back(), problems);
            return good;
        }
        return OptionType<T>::parse(value, out.emplace_back(), problems);
    }
    static std::string print(const std::vector<T>& values) {
        std::string text;
        for (const auto& v : values) append_item(text, OptionType<T>::print(v));
        return "[" + text + "]";
    }
    static Json schema() {
        const Json one = OptionType<T>::schema();
        return {{"anyOf", Json::array({one, {{"type", "array"}, {"items", one}}})}};
    }
    static std::optional<double> magnitude(const std::vector<T>&) { return {}; }
};

/// An optional value, unset unless given.
template <class T>
struct OptionType<std::optional<T>> {
    static constexpr OptionKind kind = OptionType<T>::kind;
    static constexpr Dimension dimension = OptionType<T>::dimension;
    static bool parse(const Value& value, std::optional<T>& out, Problems& problems) {
        return OptionType<T>::parse(value, out.emplace(), problems);
    }
    static std::string print(const std::optional<T>& value) {
        return value ? OptionType<T>::print(*value) : "";
    }
    static Json schema() { return OptionType<T>::schema(); }
    static std::optional<double> magnitude(const std::optional<T>& value) {
        return value ? OptionType<T>::magnitude(*value) : std::nullopt;
    }
};

/// The kind of a single value, for types whose value may be a list; otherwise the kind of the value.
template <class T>
inline constexpr OptionKind kind_of_one = OptionType<T>::kind;
template <class T>
inline constexpr OptionKind kind_of_one<std::vector<T>> = OptionType<T>::kind;
template <class T>
inline constexpr OptionKind kind_of_one<std::optional<T>> = kind_of_one<T>;

} // namespace facetmill

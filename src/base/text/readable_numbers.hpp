#pragma once
// Numbers in readable form, for reports and messages.

#include "base/math/vec.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace facetmill {

[[nodiscard]] std::string grouped(std::uint64_t count); ///< for example 1234567 -> "1,234,567"
[[nodiscard]] std::string sized(std::uint64_t bytes);   ///< 12345 -> "12.3 kB"
[[nodiscard]] std::string timed(double seconds);        ///< 0.1234 -> "0.12 s"

/// Rounded to this many digits, thousands without an exponent: 12.3456 -> "12.3 %", 40712 -> "40,700 %".
/// Numbers below 0.0001 or with more than twelve integer digits have an exponent: "1.23e-05 %".
[[nodiscard]] std::string percentage(double percent, int digits = 3);

/// The number with six digits, or "out of range".
[[nodiscard]] std::string readable(double number);
/// Six digits and at least three decimals, so that a position far from the origin can be found:
/// "5334630.125".
[[nodiscard]] std::string readable_coordinate(double x);
[[nodiscard]] std::string
readable(const Vec3& point,
         const char* between = " "); ///< for example "0.5 1 2", by readable_coordinate
[[nodiscard]] std::string readable_pair(double x, double y); ///< for example "0.5, 1", a position in a plane
/// The number as text, or "-" for none.
template <class T>
[[nodiscard]] std::string readable(const std::optional<T>& value) {
    return value ? readable(*value) : "-";
}

} // namespace facetmill

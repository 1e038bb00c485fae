#pragma once
// Converts numbers to text and back, independent of the locale, by std::from_chars and std::to_chars.

#include "base/math/vec.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace facetmill {

/// The number that the whole text represents ("1", "-2.5e3", "+4"), or none. Accepts neither nan nor inf nor
/// hexadecimal.
[[nodiscard]] std::optional<double> parse_real(std::string_view text);
/// The decimal integer that the whole text represents, or none (also when out of range). "010" is ten.
[[nodiscard]] std::optional<std::int64_t> parse_integer(std::string_view text);
/// x rounded to float32. Never inline, on purpose: GCC 12 drops both conversions when it vectorises two of
/// them (seen at -O2 and -O3).
[[nodiscard]] double as_float32(double x);
/// Rounds each coordinate to float32.
[[nodiscard]] Vec3 as_float32(const Vec3& p);
/// The shortest spelling that reads back as the same double.
[[nodiscard]] std::string to_string(double value);

} // namespace facetmill

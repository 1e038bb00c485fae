#pragma once
// Numbers as people read them, in reports and messages.

#include "base/vec.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace facetmill {

std::string grouped(std::uint64_t count); ///< 1234567 -> "1,234,567"
std::string sized(std::uint64_t bytes);   ///< 12345 -> "12.3 kB"
std::string timed(double seconds);        ///< 0.1234 -> "0.12 s"

/// To so many digits, thousands without an exponent: 12.3456 -> "12.3 %", 40712 -> "40,700 %". What is
/// smaller than 0.0001 or has more than twelve figures before the point has one: "1.23e-05 %".
std::string percentage(double percent, int digits = 3);

/// Six digits, or "out of range".
std::string readable(double number);
std::string readable(const Vec3& point); ///< "0.5 1 2"
/// ... and "-" for none.
template <class T>
std::string readable(const std::optional<T>& value) {
    return value ? readable(*value) : "-";
}

} // namespace facetmill

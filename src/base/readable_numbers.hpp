#pragma once
// Numbers as people read them, in reports and messages.

#include <cstdint>
#include <string>

namespace facetmill {

std::string grouped(std::uint64_t count); ///< 1234567 -> "1,234,567"
std::string sized(std::uint64_t bytes);   ///< 12345 -> "12.3 kB"
std::string timed(double seconds);        ///< 0.1234 -> "0.12 s"

} // namespace facetmill

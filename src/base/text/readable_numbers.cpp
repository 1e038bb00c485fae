#include "base/text/readable_numbers.hpp"

#include "base/math/numbers.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill {

std::string grouped(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, 1, ',');
    return digits;
}

std::string sized(std::uint64_t bytes) {
    if (bytes < 1000) return fmt::format("{} bytes", bytes);
    double amount = static_cast<double>(bytes) / 1000;
    const char* unit = "kB";
    for (const char* next : {"MB", "GB"})
        if (amount >= 999.95) {
            amount /= 1000;
            unit = next;
        }
    return fmt::format("{:.1f} {}", amount, unit);
}

std::string timed(double seconds) {
    return seconds < 60 ? fmt::format("{:.2f} s", seconds)
                        : fmt::format("{:.0f} min {:02.0f} s",
                                      (seconds - static_cast<double>(static_cast<int>(seconds) % 60)) / 60,
                                      static_cast<double>(static_cast<int>(seconds) % 60));
}

std::string percentage(double percent, int digits) {
    const std::string text = fmt::format("{:.{}g}", percent, digits);
    constexpr double most = 1e12; // exact as an integer
    if (!(std::abs(percent) >= 999) || !(std::abs(percent) < most)) return text + " %";
    const auto whole = static_cast<std::uint64_t>(std::abs(*parse_real(text)));
    return fmt::format("{}{} %", percent < 0 ? "-" : "", grouped(whole));
}

std::string readable(double number) {
    return std::isfinite(number) ? fmt::format("{:.6g}", number) : "out of range";
}

std::string readable_coordinate(double x) {
    constexpr double most = 1e12; // beyond this, decimals are meaningless
    if (!(std::abs(x) >= 1000 && std::abs(x) < most)) return readable(x);
    std::string text = fmt::format("{:.3f}", x);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

std::string readable_pair(double x, double y) {
    return fmt::format("{}, {}", readable_coordinate(x), readable_coordinate(y));
}

std::string readable(const Vec3& point, const char* between) {
    return fmt::format("{1}{0}{2}{0}{3}", between, readable_coordinate(point.x), readable_coordinate(point.y),
                       readable_coordinate(point.z));
}

} // namespace facetmill

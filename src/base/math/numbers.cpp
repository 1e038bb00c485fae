#include "base/math/numbers.hpp"

#include <charconv>
#include <cmath>

namespace facetmill {

namespace {
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
    return text;
}
} // namespace

std::optional<double> parse_real(std::string_view text) {
    text = without_plus(text);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return {};
    return value;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
    text = without_plus(text);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

std::string to_string(double value) {
    char buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, result.ptr};
}

[[gnu::noinline]] double as_float32(double x) { return static_cast<double>(static_cast<float>(x)); }

Vec3 as_float32(const Vec3& p) { return {as_float32(p.x), as_float32(p.y), as_float32(p.z)}; }

} // namespace facetmill

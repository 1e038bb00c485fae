#include "options/byte_count.hpp"

#include "base/math/numbers.hpp"
#include "base/text/spelling.hpp"
#include "options/types.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace facetmill {

namespace {

struct ByteUnit {
    std::string_view name;
    double bytes;
};
constexpr std::array<ByteUnit, 9> byte_units{{{"B", 1},
                                              {"kB", 1e3},
                                              {"MB", 1e6},
                                              {"GB", 1e9},
                                              {"TB", 1e12},
                                              {"KiB", 1024.0},
                                              {"MiB", 1048576.0},
                                              {"GiB", 1073741824.0},
                                              {"TiB", 1099511627776.0}}};
constexpr double max_bytes = 9007199254740992.0; // 2^53: doubles represent all counts up to this exactly

constexpr const char* bytes_expected = "a count of bytes (1000000, 10MB, 1.5MiB, 8G)";

/// The unit with this name. A single letter is a multiple of 1024, as in coreutils, Docker and Slurm.
const ByteUnit* byte_unit(std::string_view name) {
    const auto letter = name.size() == 1 ? std::string_view("kmgt").find(lower_case(std::string(name)))
                                         : std::string_view::npos;
    if (letter != std::string_view::npos) return &byte_units[5 + letter];
    const auto unit =
        std::find_if(byte_units.begin(), byte_units.end(), [&](const ByteUnit& u) { return u.name == name; });
    return unit == byte_units.end() ? nullptr : &*unit;
}

/// A hint for a unit in the wrong case ("mb", "Gb"): the two possible units.
std::string byte_unit_hint(double number, std::string_view unit) {
    const std::string small = lower_case(std::string(unit));
    const auto at = std::string_view("kmgt").find(small.empty() ? '?' : small[0]);
    const std::string rest = small.empty() ? "" : small.substr(1);
    if (at == std::string_view::npos || !(rest.empty() || rest == "b" || rest == "i" || rest == "ib"))
        return "units: B, kB, MB, GB, TB, KiB, MiB, GiB, TiB, and K, M, G, T for 1024 bytes each step";
    const ByteUnit &decimal = byte_units[1 + at], &binary = byte_units[5 + at];
    return fmt::format("{0}{1} ({2:.0f} bytes each) or {0}{3} ({4:.0f})?", to_string(number), decimal.name,
                       decimal.bytes, binary.name, binary.bytes);
}

} // namespace

std::optional<double> read_byte_count(const Value& value, Problems& problems) {
    double bytes = 0;
    if (const auto number = value.as_real())
        bytes = *number;
    else {
        const auto parts = value.is_scalar() ? number_and_unit(value.text) : std::nullopt;
        const ByteUnit* unit = parts ? byte_unit(parts->second) : nullptr;
        if (!unit) {
            wrong_type(value, bytes_expected, problems,
                       parts && !parts->second.empty() ? byte_unit_hint(parts->first, parts->second) : "");
            return {};
        }
        bytes = parts->first * unit->bytes;
    }
    const double whole = std::round(bytes); // 4.35kB times 1000 may miss 4350 by the last bit
    if (bytes >= 0 && bytes <= max_bytes && std::abs(bytes - whole) <= 1e-12 * whole) return whole;
    problems.add(value.mark, "E-RANGE", fmt::format("'{}' is not a number of bytes", value.text),
                 bytes < 0           ? "bytes cannot be negative"
                 : bytes > max_bytes ? "at most 9007199254740992 (8192TiB)"
                                     : "a number of bytes must be whole");
    return {};
}

} // namespace facetmill

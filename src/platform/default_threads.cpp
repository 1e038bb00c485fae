#include "base/error.hpp"
#include "base/math/numbers.hpp"
#include "platform/cores.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace facetmill {

int default_threads() {
    const char* given = std::getenv("FACETMILL_JOBS");
    if (!given || !*given) return allowed_cores();
    constexpr int most = 4096;
    const auto count = parse_integer(given);
    if (!count || *count < 1 || *count > most)
        throw Error(ErrorKind::usage, "E-ARGUMENT",
                    fmt::format("FACETMILL_JOBS must be between 1 and {}, found '{}'", most, given),
                    "unset it to use all cores");
    return static_cast<int>(*count);
}

} // namespace facetmill

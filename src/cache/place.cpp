#include "cache/place.hpp"

#include "base/error.hpp"
#include "options/byte_count.hpp"

#include <cstdlib>
#include <fmt/format.h>

namespace facetmill::cache {

namespace fs = std::filesystem;

namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

} // namespace

std::optional<fs::path> folder(bool usual) {
    const std::string named = variable("FACETMILL_CACHE");
    if (named == "off") return {};
    if (!named.empty()) return fs::absolute(named).lexically_normal();
    if (!usual) return {};
    const std::string caches = variable("XDG_CACHE_HOME"), home = variable("HOME");
    if (fs::path(caches).is_absolute()) return fs::path(caches) / "facetmill"; // others are to be ignored
    if (fs::path(home).is_absolute()) return fs::path(home) / ".cache" / "facetmill";
    return {};
}

bool is_left_out_of_ci() { return variable("CI") == "true" && variable("FACETMILL_CACHE").empty(); }

std::uint64_t size_limit() {
    constexpr std::uint64_t usual = std::uint64_t{5} << 30;
    const std::string text = variable("FACETMILL_CACHE_SIZE");
    if (text.empty()) return usual;
    Problems problems;
    const auto bytes = read_byte_count(Value::scalar(text), problems);
    if (bytes && *bytes > 0) return static_cast<std::uint64_t>(*bytes);
    throw Error(ErrorKind::usage, "E-ARGUMENT",
                fmt::format("FACETMILL_CACHE_SIZE is an amount, found '{}'", text), "5GB, 500MiB");
}

} // namespace facetmill::cache

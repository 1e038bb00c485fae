#include "cache/place.hpp"

#include "base/error.hpp"
#include "options/byte_count.hpp"
#include "platform/file_status.hpp"

#include <cerrno>
#include <cstdlib>
#include <fmt/format.h>

namespace facetmill::cache {

namespace fs = std::filesystem;

namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// True if the folder belongs to this user, or does not exist.
bool is_own_or_missing(const fs::path& folder) {
    const auto about = status_of(folder);
    return about ? about->is_own() : errno == ENOENT;
}

bool is_own(const fs::path& folder) {
    const auto about = status_of(folder);
    return about && about->is_own();
}

} // namespace

bool is_named() { return !variable("FACETMILL_CACHE").empty(); }

std::optional<fs::path> folder() {
    const std::string named = variable("FACETMILL_CACHE");
    if (named == "off") return {};
    if (!named.empty()) return fs::absolute(named).lexically_normal();
    // Only Windows sets LOCALAPPDATA.
    const std::string given = variable("XDG_CACHE_HOME");
    const fs::path caches = given.empty() ? variable("LOCALAPPDATA") : given, home = variable("HOME");
    if (caches.is_absolute()) // relative paths must be ignored
        return is_own_or_missing(caches) ? std::optional(caches / "facetmill") : std::nullopt;
    if (!home.is_absolute() || !is_own(home) || !is_own_or_missing(home / ".cache")) return {};
    return home / ".cache" / "facetmill";
}

bool is_ci() { return variable("CI") == "true"; }

Limit size_limit() {
    constexpr std::uint64_t usual = std::uint64_t{5} << 30;
    constexpr double usual_share = 0.1;
    const std::string text = variable("FACETMILL_CACHE_SIZE");
    if (text.empty()) return {usual, usual_share};
    Problems problems;
    const auto bytes = read_byte_count(Value::scalar(text), problems);
    if (bytes && *bytes > 0) return {static_cast<std::uint64_t>(*bytes)};
    throw Error(ErrorKind::usage, "E-ARGUMENT",
                fmt::format("FACETMILL_CACHE_SIZE must be a size, found '{}'", text), "5GB, 500MiB");
}

} // namespace facetmill::cache

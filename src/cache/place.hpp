#pragma once
// The location of this user's cache, and its size limit.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace facetmill::cache {

/// The folder in FACETMILL_CACHE, otherwise facetmill in XDG_CACHE_HOME or ~/.cache. None for
/// FACETMILL_CACHE=off, or without such a location. Also none if the usual location belongs to another user,
/// who could not remove the files (sudo with the caller's HOME).
[[nodiscard]] std::optional<std::filesystem::path> folder();

/// True if FACETMILL_CACHE is set and not empty, even to "off", so that the user has explicitly decided
/// about a cache.
bool is_named();

/// True in a CI job (CI=true). Such a job keeps only files that its configuration names, so the cache is off
/// unless it is requested.
bool is_ci();

/// The size limit of the cache.
struct Limit {
    std::uint64_t bytes = 0;
    double share = 1; ///< share of the cache's size plus the free space of its disk
};
/// The limit from FACETMILL_CACHE_SIZE (5GB, 500MiB); by default 5 GiB and a tenth of the space. Throws a
/// usage error (E-ARGUMENT) for an invalid amount.
[[nodiscard]] Limit size_limit();

} // namespace facetmill::cache

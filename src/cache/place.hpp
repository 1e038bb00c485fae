#pragma once
// The location of this user's cache, and its size limit.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace facetmill::cache {

/// The folder in FACETMILL_CACHE, else facetmill in XDG_CACHE_HOME or ~/.cache. None for
/// FACETMILL_CACHE=off, if no such folder is defined, and if the usual one is in a folder of another user,
/// who could not remove the files (sudo with the caller's HOME).
std::optional<std::filesystem::path> folder();

/// Whether FACETMILL_CACHE names a folder: then the user requested a cache.
bool is_named();

/// Whether this is a CI job (CI=true): only its configuration decides which files survive.
bool is_ci();

/// How large the cache may be.
struct Limit {
    std::uint64_t bytes = 0;
    double share = 1; ///< relative to the sum of its size and the free space of its disk
};
/// FACETMILL_CACHE_SIZE (5GB, 500MiB); by default 5 GiB and a tenth of the space. Throws usage (E-ARGUMENT)
/// for an invalid amount.
Limit size_limit();

} // namespace facetmill::cache

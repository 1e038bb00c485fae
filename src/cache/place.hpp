#pragma once
// Where the cache of this user is, and how large it may be.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace facetmill::cache {

/// The folder that FACETMILL_CACHE names, else facetmill in XDG_CACHE_HOME or ~/.cache. None for
/// FACETMILL_CACHE=off, where there is no such place, and where the usual one is in a folder of another user,
/// who could not remove what is put there (sudo with the HOME of whoever called it).
std::optional<std::filesystem::path> folder();

/// Whether FACETMILL_CACHE names a folder: then the user asked for a cache.
bool is_named();

/// Whether this is a job of a CI (CI=true): what is kept of such a job is said there or nowhere.
bool is_ci();

/// How large the cache may be.
struct Limit {
    std::uint64_t bytes = 0;
    double share = 1; ///< of what it and free space of its disk are together
};
/// FACETMILL_CACHE_SIZE (5GB, 500MiB); by default 5 GiB and a tenth of the space. Throws usage (E-ARGUMENT)
/// for what is no amount.
Limit size_limit();

} // namespace facetmill::cache

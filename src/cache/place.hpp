#pragma once
// Where the cache of this user is, and how large it may be.

#include <cstdint>
#include <filesystem>
#include <optional>

namespace facetmill::cache {

/// The folder that FACETMILL_CACHE names; with usual, where it names none, facetmill in XDG_CACHE_HOME or
/// ~/.cache. None where there is no such place, and for FACETMILL_CACHE=off.
std::optional<std::filesystem::path> folder(bool usual);

/// Whether this is a job of a CI (CI=true) that FACETMILL_CACHE names no folder for: what is kept of such a
/// job is said there or nowhere.
bool is_left_out_of_ci();

/// FACETMILL_CACHE_SIZE (5GB, 500MiB), by default 5 GiB. Throws usage (E-ARGUMENT) for what is no amount.
std::uint64_t size_limit();

} // namespace facetmill::cache

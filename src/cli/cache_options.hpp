#pragma once
// The cache options of a run, and the cache that they select.

#include "cache/store.hpp"
#include "cli/command.hpp"

namespace facetmill::cli {

struct CacheOptions {
    bool on = false, off = false, everything = false;
};

/// Adds --cache and --no-cache.
void add_cache_options(Arguments& arguments, CacheOptions& options);

/// The folder of the run's store, created if missing. None without a store, or if creating it fails. For the
/// sandbox.
[[nodiscard]] std::optional<std::filesystem::path> cache_folder(const CacheOptions& options);

/// The store for a run, by default enabled. Null with --no-cache, FACETMILL_CACHE=off, or without a default
/// folder (cache::folder). Also null with CI=true unless --cache or FACETMILL_CACHE request it. Problems are
/// reported (W-CACHE) if the cache was requested or with tells_all, unless the id is allowed; notes are
/// always reported. Throws a usage error if both options are given, and if --cache finds no folder.
[[nodiscard]] std::unique_ptr<cache::Store> store_for(const CacheOptions& options,
                                                      const std::vector<std::string>& allowed,
                                                      const Console& console, bool tells_all = false);

} // namespace facetmill::cli

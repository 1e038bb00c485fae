#pragma once
// The options that say whether a run uses the cache, and the cache that they say.

#include "cache/store.hpp"
#include "cli/command.hpp"

namespace facetmill::cli {

struct CacheOptions {
    bool on = false, off = false, everything = false;
};

/// --cache and --no-cache.
void add_cache_options(Arguments& arguments, CacheOptions& options);

/// The folder of the store for a run, which is made when it is not there; none for no store, or where it
/// cannot be made. For the sandbox.
std::optional<std::filesystem::path> cache_folder(const CacheOptions& options);

/// The store for a run: by default there is one. Null with --no-cache, FACETMILL_CACHE=off, where no usual
/// place is (cache::folder), and with CI=true unless --cache or FACETMILL_CACHE ask for it. It tells what
/// hinders it (W-CACHE) where they do or with tells_all, unless the id is allowed, and notes always. Throws
/// usage when both options are given, and when --cache finds no place.
std::unique_ptr<cache::Store> store_for(const CacheOptions& options, const std::vector<std::string>& allowed,
                                        const Console& console, bool tells_all = false);

} // namespace facetmill::cli

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

/// The store that the options and FACETMILL_CACHE ask for, which tells what hinders it unless W-CACHE is
/// among the allowed warnings; null for none, and with CI=true where FACETMILL_CACHE names no folder. Throws
/// usage when both options are given.
std::unique_ptr<cache::Store> store_for(const CacheOptions& options, const std::vector<std::string>& allowed,
                                        const Console& console);

} // namespace facetmill::cli

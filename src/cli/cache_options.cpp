#include "cli/cache_options.hpp"

#include "cache/place.hpp"

namespace facetmill::cli {

void add_cache_options(Arguments& arguments, CacheOptions& options) {
    arguments.add("--cache", &options.on,
                  "Takes results of stages from the cache and stores them: only what changed runs again.");
    arguments.add("--no-cache", &options.off, "Uses no cache, even if FACETMILL_CACHE names one.");
    arguments.add("--cache-everything", &options.everything, "Also stores results that are cheap to compute.")
        .hidden();
}

std::unique_ptr<cache::Store> store_for(const CacheOptions& options, const std::vector<std::string>& allowed,
                                        const Console& console) {
    if (options.on && options.off)
        throw Error(ErrorKind::usage, "E-ARGUMENT", "--cache and --no-cache exclude each other");
    if (options.off || cache::is_left_out_of_ci()) return nullptr;
    const auto folder = cache::folder(options.on);
    if (!folder && options.on)
        throw Error(ErrorKind::usage, "E-ARGUMENT", "--cache finds no folder for it",
                    "FACETMILL_CACHE names one (and is not off), or HOME");
    if (!folder) return nullptr;
    std::function<void(const Diagnostic&)> tell = [&console, allowed](const Diagnostic& d) {
        if (!is_allowed(d, allowed)) console.diagnostic(d);
    };
    return std::make_unique<cache::Store>(
        cache::StoreSettings{*folder, cache::size_limit(), options.everything, std::move(tell)});
}

} // namespace facetmill::cli

#include "cli/cache_options.hpp"

#include "cache/place.hpp"

namespace facetmill::cli {

void add_cache_options(Arguments& arguments, CacheOptions& options) {
    arguments.add("--no-cache", &options.off, "Neither reads nor stores results of stages in the cache.");
    arguments.add("--cache", &options.on,
                  "Uses the cache even if CI=true, and warns if it cannot be written.");
    arguments.add("--cache-everything", &options.everything, "Also stores results that are cheap to compute.")
        .hidden();
}

namespace {

/// Whether the user requested a cache, and does not use it by default.
bool is_asked_for(const CacheOptions& options) { return options.on || cache::is_named(); }

bool is_left_out(const CacheOptions& options) {
    return options.off || (cache::is_ci() && !is_asked_for(options));
}

} // namespace

std::optional<std::filesystem::path> cache_folder(const CacheOptions& options) {
    auto folder = is_left_out(options) ? std::nullopt : cache::folder();
    if (folder && !cache::make_folders(*folder)) return {}; // the store reports the reason
    return folder;
}

std::unique_ptr<cache::Store> store_for(const CacheOptions& options, const std::vector<std::string>& allowed,
                                        const Console& console, bool tells_all) {
    if (options.on && options.off)
        throw Error(ErrorKind::usage, "E-CONFLICT", "--cache and --no-cache exclude each other",
                    "remove one of them");
    const bool asked = is_asked_for(options);
    if (is_left_out(options)) return nullptr;
    const auto folder = cache::folder();
    if (!folder && options.on)
        throw Error(ErrorKind::usage, "E-ARGUMENT", "--cache finds no folder",
                    "set FACETMILL_CACHE to a folder, or HOME to a folder of this user");
    if (!folder) return nullptr;
    const auto limit = cache::size_limit();
    std::function<void(const Diagnostic&)> tell = [&console, allowed, asked, tells_all](const Diagnostic& d) {
        // Users who did not request a cache need no message about a missing cache.
        const bool wanted = asked || tells_all || d.severity != Severity::warning;
        if (wanted && !is_allowed(d, allowed)) console.diagnostic(d);
    };
    return std::make_unique<cache::Store>(cache::StoreSettings{.folder = *folder,
                                                               .max_bytes = limit.bytes,
                                                               .everything = options.everything,
                                                               .tell = std::move(tell),
                                                               .max_share = limit.share});
}

} // namespace facetmill::cli

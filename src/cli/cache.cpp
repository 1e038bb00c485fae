// facetmill cache: shows and shrinks the cache of results.

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "cache/place.hpp"
#include "cache/store.hpp"
#include "cli/command.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* cache_examples =
    R"(The cache stores results of stages for later runs (run, pipe, batch). Outputs are byte for byte the same with and
without it. The key of a result contains everything that it depends on: inputs, options, the previous stages, this
program and its libraries. A result is stored if storing takes at most a tenth of the time of its stages.

The folder is $XDG_CACHE_HOME/facetmill or ~/.cache/facetmill. You can delete it at any time. If the cache exceeds
5 GiB or a tenth of the free disk space, the least recently used entries are removed first.

--no-cache turns the cache off for one run. FACETMILL_CACHE sets another folder, and the value off turns the cache off.
FACETMILL_CACHE_SIZE sets another limit (20G). If CI=true, the cache is only used with --cache, or if FACETMILL_CACHE
names a folder.

  stats   shows the folder and the size of its contents
  gc      removes leftovers of killed runs, and entries beyond the limit
  clear   removes everything

Examples
  facetmill run scan.yaml -D input=scan.ply --explain
  facetmill cache stats
  FACETMILL_CACHE_SIZE=500M facetmill cache gc
)";

void tell_contents(const cache::Store& store, bool json) {
    const auto there = store.contents();
    const auto limit = store.limit(there.bytes);
    const std::string folder = store.settings().folder.generic_string(), hindrance = store.hindrance();
    if (json) {
        const Json all = {{"folder", folder},       {"entries", there.entries},
                          {"scenes", there.scenes}, {"bytes", there.bytes},
                          {"limit", limit},         {"writable", hindrance.empty()}};
        return print(all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
    }
    show(fmt::format("{}\n{}, {} of them scenes, {} of at most {}\n", folder,
                     counted(there.entries, "entry", "entries"), there.scenes, sized(there.bytes),
                     sized(limit)));
    if (!hindrance.empty()) show(fmt::format("cannot be written: {}\n", hindrance));
}

int cache_work(const std::string& action, bool json) {
    const auto folder = cache::folder();
    if (!folder)
        throw Error(ErrorKind::usage, "E-ARGUMENT", "the cache has no folder",
                    "set FACETMILL_CACHE to a folder, or HOME to a folder of this user");
    const auto limit = cache::size_limit();
    cache::Store store({.folder = *folder, .max_bytes = limit.bytes, .max_share = limit.share});
    if (action == "stats") {
        tell_contents(store, json);
        return 0;
    }
    const auto gone = action == "gc" ? store.collect() : store.clear();
    print(fmt::format("removed {}, {}\n", counted(gone.entries, "entry", "entries"), sized(gone.bytes)));
    return 0;
}

} // namespace

Command cache_command() {
    return {"cache",
            "Shows or empties the cache of results.",
            cache_examples,
            {},
            [](Arguments& arguments, Console&) {
                auto action = std::make_shared<std::string>("stats");
                auto json = std::make_shared<bool>(false);
                arguments.add("ACTION", action.get(), "stats, gc or clear. Default: stats.")
                    .one_of({"stats", "gc", "clear"});
                arguments.add("--json", json.get(), "Prints JSON (for stats).");
                return [=](const Invocation&) { return cache_work(*action, *json); };
            }};
}

} // namespace facetmill::cli

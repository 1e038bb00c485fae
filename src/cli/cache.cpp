// facetmill cache: what is in the cache of results, and how it gets smaller.

#include "base/readable_numbers.hpp"
#include "base/words.hpp"
#include "cache/place.hpp"
#include "cache/store.hpp"
#include "cli/command.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* cache_examples =
    R"(The cache stores results of stages for run, pipe and batch with --cache, or if FACETMILL_CACHE names its folder.
FACETMILL_CACHE_SIZE limits its size (5G); the least recently used entries are removed first. It may be deleted at any
time. The key of a result is made of everything that it depends on: inputs, options, the previous stages, this program
and its libraries. A result is stored if that takes at most a tenth of the time of the stages that it saves.

  stats   shows the folder, and how much is in it
  gc      removes leftovers of runs that were killed, and entries beyond the limit
  clear   removes everything

Examples
  facetmill run scan.yaml --cache --explain
  facetmill cache stats
  FACETMILL_CACHE_SIZE=500M facetmill cache gc
)";

void tell_contents(const cache::Store& store, bool json) {
    const auto there = store.contents();
    const auto& settings = store.settings();
    if (json) {
        const Json all = {{"folder", settings.folder.string()},
                          {"entries", there.entries},
                          {"scenes", there.scenes},
                          {"bytes", there.bytes},
                          {"limit", settings.max_bytes}};
        return print(all.dump(2) + "\n");
    }
    print(fmt::format("{}\n{}, {} of them scenes, {} of at most {}\n", settings.folder.string(),
                      counted(there.entries, "entry", "entries"), there.scenes, sized(there.bytes),
                      sized(settings.max_bytes)));
}

int cache_work(const std::string& action, bool json) {
    const auto folder = cache::folder(true);
    if (!folder)
        throw Error(ErrorKind::usage, "E-ARGUMENT", "no folder for a cache is known",
                    "FACETMILL_CACHE names one (and is not off), or HOME");
    cache::Store store({*folder, cache::size_limit()});
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
    return {"cache", "Shows or empties the cache of results.", cache_examples, false,
            [](Arguments& arguments, Console&) {
                auto action = std::make_shared<std::string>();
                auto json = std::make_shared<bool>(false);
                arguments.add("ACTION", action.get(), "stats, gc or clear.")
                    .one_of({"stats", "gc", "clear"})
                    .required();
                arguments.add("--json", json.get(), "Prints JSON (stats).");
                return [=](const Invocation&) { return cache_work(*action, *json); };
            }};
}

} // namespace facetmill::cli

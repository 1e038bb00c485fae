#pragma once
// What became of each step of a run, and why, compared with the run before: facetmill run --explain.

#include "base/json.hpp"
#include "cache/store.hpp"

namespace facetmill::pipeline {

struct Plan;

struct TracedStep {
    enum class Way {
        ran,      ///< nothing of it was in the cache
        recalled, ///< from the cache
        again,    ///< recalled, but its scene was needed and not in the cache
        always,   ///< it is one that is never recalled
        skipped,  ///< `when` did not hold
    };
    std::string name, stage;
    Json options = Json::object(); ///< as facetmill plan --json has them, and `only`
    std::vector<std::pair<std::string, std::string>> inputs; ///< paths and digests
    std::string before{};                                    ///< the key of the scene that it gets
    std::string key{};                                       ///< empty: it has none
    Way way = Way::ran;
};
using Trace = std::vector<TracedStep>;

/// A line for each step: "simplify reruns: ratio 0.5 -> 0.4". Compares with the last run of this pipeline
/// file that wrote the same files, as far as the store knows of it. pipeline_file: empty for a ready
/// pipeline, or a one-liner.
std::vector<std::string> explained(const Trace& trace, const Plan& plan, const std::string& pipeline_file,
                                   cache::Store& store);
/// Remembers the run as the last one of this pipeline file that wrote these files. whole: it came to its end;
/// else what is known of the steps that it did not reach stays.
void remember(const Trace& trace, const Plan& plan, const std::string& pipeline_file, bool whole,
              cache::Store& store);

} // namespace facetmill::pipeline

#pragma once
// Explains how each step of a run was done, and why, compared with the previous run: facetmill run --explain.

#include "base/json.hpp"
#include "cache/store.hpp"

namespace facetmill::pipeline {

struct Plan;

struct TracedStep {
    enum class Way {
        ran,      ///< not in the cache
        recalled, ///< from the cache
        again,    ///< recalled, then run because its scene was needed and not in the cache
        always,   ///< never recalled
        skipped,  ///< `when` did not hold
    };
    std::string name, stage;
    Json options = Json::object(); ///< the options as in facetmill plan --json, and `only`
    std::vector<std::pair<std::string, std::string>> inputs; ///< paths and digests
    std::string before{};                                    ///< the key of its input scene
    std::string key{};                                       ///< empty: no key
    Way way = Way::ran;
};
using Trace = std::vector<TracedStep>;

/// A line for each step: "simplify reruns: ratio 0.5 -> 0.4". Compares with the last run of this pipeline
/// file with the same outputs, as far as the store has it. pipeline_file: empty for a built-in pipeline or a
/// one-liner.
[[nodiscard]] std::vector<std::string> explained(const Trace& trace, const Plan& plan,
                                                 const std::string& pipeline_file, cache::Store& store);
/// Stores the run as the last run of this pipeline file with these outputs. whole: it was complete; otherwise
/// the data of steps that it did not reach stays.
void remember(const Trace& trace, const Plan& plan, const std::string& pipeline_file, bool whole,
              cache::Store& store);

} // namespace facetmill::pipeline

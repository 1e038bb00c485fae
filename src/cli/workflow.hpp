#pragma once
// Runs of many assets as a workflow for another engine: a job per asset or group of assets, with its inputs,
// outputs and resources.

#include <cstdint>
#include <string>
#include <vector>

namespace facetmill::cli {

struct Job {
    std::string name;                           ///< for people
    std::vector<std::vector<std::string>> runs; ///< the arguments of consecutive runs of facetmill
    std::vector<std::string> inputs, outputs;   ///< files; at least one output per run
    std::uint64_t memory = 0;                   ///< an estimate, in bytes
    /// Missing files that inputs name. The job runs again when they appear, except in Ninja, which has no
    /// optional inputs.
    std::vector<std::string> absent{};
    std::vector<std::string> targets{}; ///< for each run: the target of its depfile; empty: no depfiles
};

/// Groups up to `size` jobs into a job, in order. A failing run does not stop the other runs of its group.
/// Throws a usage error (E-EXPORT) for a job without outputs.
[[nodiscard]] std::vector<Job> in_shards(std::vector<Job> jobs, std::size_t size);

/// The folder of depfiles, in the working directory. Names in it do not depend on other jobs.
inline constexpr const char* depfile_folder = ".facetmill-depfiles";

/// The resources of parallel jobs.
struct Resources {
    int threads = 1; ///< threads of each job
    int cores = 1;
    std::uint64_t memory = 0;          ///< in bytes
    std::string program = "facetmill"; ///< the path of the executable, for Ninja
};

/// The number of parallel jobs that need little memory, and that need much. A job that needs more than all
/// memory runs alone.
struct Lanes {
    std::size_t small = 1, large = 0;
    std::uint64_t small_up_to = 0; ///< bytes; jobs that need more are large
};
[[nodiscard]] Lanes lanes_of(const std::vector<Job>& jobs, const Resources& resources);

/// Throws a usage error (E-EXPORT) for a job without outputs, and for a group whose command exceeds the
/// shell's limit. Throws an output error (E-DEPFILE) for a name with a line break, which these engines
/// cannot represent.
[[nodiscard]] std::string ninja_workflow(const std::vector<Job>& jobs, const Resources& resources);
[[nodiscard]] std::string make_workflow(const std::vector<Job>& jobs, const Resources& resources);
[[nodiscard]] std::string snakemake_workflow(const std::vector<Job>& jobs, const Resources& resources);

} // namespace facetmill::cli

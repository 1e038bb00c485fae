#pragma once
// Runs of many assets as a workflow of another engine: a job for each asset or for several, with what it
// reads, writes and needs.

#include <cstdint>
#include <string>
#include <vector>

namespace facetmill::cli {

struct Job {
    std::string name;                           ///< for people
    std::vector<std::vector<std::string>> runs; ///< of facetmill, one after the other: their arguments
    std::vector<std::string> inputs, outputs;   ///< files; at least one output a run
    std::uint64_t memory = 0;                   ///< an estimate, in bytes
};

/// Jobs of up to `size` of these each, in their order. One that fails lets the others of its shard run.
/// Throws usage (E-EXPORT) for a job without outputs.
std::vector<Job> in_shards(std::vector<Job> jobs, std::size_t size);

/// What jobs that run at a time may take.
struct Resources {
    int threads = 1; ///< of each job
    int cores = 1;
    std::uint64_t memory = 0; ///< bytes
};

/// How many jobs may run at a time: those that need little memory, and those that need much, which is all by
/// itself where a single one is more than there is.
struct Lanes {
    std::size_t small = 1, large = 0;
    std::uint64_t small_up_to = 0; ///< bytes; jobs that need more are large
};
Lanes lanes_of(const std::vector<Job>& jobs, const Resources& resources);

/// Throws usage (E-EXPORT) for a job without outputs and for a shard whose command is
/// longer than a shell takes, output (E-DEPFILE) for a name with a line break, which these cannot spell.
std::string ninja_workflow(const std::vector<Job>& jobs, const Resources& resources);
std::string make_workflow(const std::vector<Job>& jobs, const Resources& resources);
std::string snakemake_workflow(const std::vector<Job>& jobs, const Resources& resources);

} // namespace facetmill::cli

#pragma once
// Runs of many assets as a workflow of another engine: a job an asset, with what it reads, writes and needs.

#include <cstdint>
#include <string>
#include <vector>

namespace facetmill::cli {

struct Job {
    std::string name;                         ///< for people
    std::vector<std::string> arguments;       ///< of facetmill
    std::vector<std::string> inputs, outputs; ///< files; at least one output
    std::uint64_t memory = 0;                 ///< an estimate, in bytes
};

/// threads: of each job. Throws usage (E-EXPORT) for a job without outputs, output (E-DEPFILE) for a name
/// with a line break, which these cannot spell.
std::string ninja_workflow(const std::vector<Job>& jobs);
std::string make_workflow(const std::vector<Job>& jobs);
std::string snakemake_workflow(const std::vector<Job>& jobs, int threads);

} // namespace facetmill::cli

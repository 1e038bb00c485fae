#include "support/catch.hpp"

#include "cli/workflow.hpp"

namespace workflow_test {

using namespace facetmill::cli;
using facetmill::cli::Job; // batch has one, too

namespace {

constexpr std::uint64_t megabyte = 1000000;

std::vector<Job> jobs_of(const std::vector<std::uint64_t>& megabytes) {
    std::vector<Job> jobs;
    for (const auto size : megabytes)
        jobs.push_back({.name = "a",
                        .runs = {{"run", "p.yaml"}},
                        .inputs = {"a.ply"},
                        .outputs = {"a.glb"},
                        .memory = size * megabyte});
    return jobs;
}

/// The largest memory that jobs of both kinds use at the same time.
std::uint64_t most(const std::vector<Job>& jobs, const Lanes& lanes) {
    std::uint64_t small = 0, large = 0;
    for (const Job& job : jobs) {
        auto& of = lanes.large > 0 && job.memory > lanes.small_up_to ? large : small;
        of = std::max(of, job.memory);
    }
    return small * lanes.small + large * lanes.large;
}

} // namespace

TEST_CASE("jobs at a time fit into cores and memory", "[cli]") {
    const auto few = jobs_of({10, 20, 30});
    CHECK(lanes_of(few, {1, 8, 1000 * megabyte}).small == 8);
    CHECK(lanes_of(few, {3, 8, 1000 * megabyte}).small == 2);
    CHECK(lanes_of(few, {16, 8, 1000 * megabyte}).small == 1);
    CHECK(lanes_of(few, {1, 8, 1000 * megabyte}).large == 0);
    const auto mixed = jobs_of({10, 20, 300});
    const Lanes lanes = lanes_of(mixed, {1, 8, 1000 * megabyte});
    CHECK(lanes.large == 1);
    CHECK(lanes.small == 7);
    CHECK(most(mixed, lanes) <= 1000 * megabyte);
    const auto all_large = jobs_of({300, 300, 300});
    CHECK(lanes_of(all_large, {1, 8, 1000 * megabyte}).large == 3);
    const auto too_large = jobs_of({10, 3000});
    CHECK(lanes_of(too_large, {1, 8, 1000 * megabyte}).large == 1);
    for (const int cores : {1, 2, 3, 16})
        for (const std::uint64_t memory : {400, 700, 5000}) {
            const Lanes found = lanes_of(mixed, {1, cores, memory * megabyte});
            CHECK(found.small >= 1);
            if (memory > 600) CHECK(most(mixed, found) <= memory * megabyte);
        }
}

TEST_CASE("workflows say what each job needs", "[cli]") {
    const auto mixed = jobs_of({10, 300});
    const std::string ninja = ninja_workflow(mixed, {2, 8, 500 * megabyte});
    CHECK(ninja.find("pool small\n  depth = 3\n") != ninja.npos);
    CHECK(ninja.find("pool large\n  depth = 1\n") != ninja.npos);
    CHECK(ninja.find("  threads = 2\n  megabytes = 10\n\n") != ninja.npos);
    CHECK(ninja.find("  threads = 2\n  megabytes = 300\n  pool = large\n") != ninja.npos);
    const std::string make = make_workflow(mixed, {2, 8, 500 * megabyte});
    CHECK(make.find("\n# -j1 suits 8 cores, jobs of 2 threads and 500.0 MB of memory") != make.npos);
    CHECK(make.find("\n# 2 threads, about 300 MB\n") != make.npos);
}

} // namespace workflow_test

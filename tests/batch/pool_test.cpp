#include "support/catch.hpp"

#include "batch/pool.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

using namespace facetmill;
using namespace facetmill::batch;

namespace {

/// The jobs that ran, and how many ran at the same time.
struct Trace {
    std::mutex guard;
    std::vector<std::size_t> begun;
    int running = 0, max = 0;
    std::uint64_t memory = 0, max_memory = 0;
    int wanted = 1; ///< a job waits up to some seconds until this many run at the same time

    bool is_met() {
        const std::lock_guard lock(guard);
        return max >= wanted;
    }

    Pool::DoJob work(Next next = Next::go_on) {
        return [this, next](const Job& job, const std::function<bool()>&) {
            {
                const std::lock_guard lock(guard);
                begun.push_back(job.index);
                max = std::max(max, ++running);
                max_memory = std::max(max_memory, memory += job.memory);
            }
            for (int tick = 0; tick < 1 || (tick < 2000 && !is_met()); ++tick)
                std::this_thread::sleep_for(std::chrono::milliseconds(5));
            const std::lock_guard lock(guard);
            --running;
            memory -= job.memory;
            return next;
        };
    }
};

std::vector<Job> jobs_of(std::vector<std::uint64_t> memory) {
    std::vector<Job> jobs;
    for (const auto bytes : memory) jobs.push_back({jobs.size(), bytes, false});
    return jobs;
}

/// Limits the threads of all arenas before any is made, as the program does.
struct Threads {
    explicit Threads(int count) { set_threads(count); }
    ~Threads() { set_threads(0); }
};

} // namespace

TEST_CASE("jobs run as many at a time as allowed", "[batch]") {
    const Threads threads(3);
    Trace trace;
    trace.wanted = 2;
    Pool({3, 100, nullptr}, jobs_of({1, 1, 1, 1, 1, 1, 1, 1, 1}), trace.work()).run();
    CHECK(trace.begun.size() == 9);
    CHECK(trace.max > 1);
    CHECK(trace.max <= 3);
}

TEST_CASE("jobs wait for memory, and one that exceeds it runs alone", "[batch]") {
    const Threads threads(4);
    Trace trace;
    Pool({4, 100, nullptr}, jobs_of({60, 60, 500, 40, 60, 10}), trace.work()).run();
    std::sort(trace.begun.begin(), trace.begun.end()); // two parallel jobs may begin in either order
    CHECK(trace.begun == std::vector<std::size_t>{0, 1, 2, 3, 4, 5});
    CHECK(trace.max_memory == 500);
    Trace small;
    Pool({4, 100, nullptr}, jobs_of({60, 60, 40, 60, 10}), small.work()).run();
    CHECK(small.max_memory <= 100);
}

TEST_CASE("after a stop nothing begins", "[batch]") {
    Trace trace;
    Pool({1, 100, nullptr}, jobs_of({1, 1, 1}), trace.work(Next::stop)).run();
    CHECK(trace.begun == std::vector<std::size_t>{0});
}

TEST_CASE("a job that is run again has nothing beside it", "[batch]") {
    const Threads threads(3);
    Trace trace;
    auto work = trace.work();
    std::mutex guard;
    int again = 0;
    bool beside = false;
    Pool({3, 100, nullptr}, jobs_of({1, 1, 1, 1}), [&](const Job& job, const std::function<bool()>& others) {
        work(job, others);
        const std::lock_guard lock(guard);
        if (job.alone) beside = beside || others() || trace.running > 0;
        if (job.index != 1 || job.alone) return Next::go_on;
        ++again;
        return Next::again_alone;
    }).run();
    CHECK(again == 1);
    CHECK(std::count(trace.begun.begin(), trace.begun.end(), std::size_t{1}) == 2);
    CHECK_FALSE(beside);
}

#pragma once
// Runs jobs on shared threads, admitted as cores and memory allow.

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <vector>

namespace facetmill::batch {

class Jobserver;

struct Job {
    std::size_t index = 0;
    std::uint64_t memory = 0; ///< bytes, an estimate
    bool alone = false;       ///< no other job may run at the same time
};

/// The action after a job.
enum class Next {
    go_on,
    stop,        ///< start no more jobs
    again_alone, ///< run the job again, alone
};

struct PoolSettings {
    int jobs = 1;             ///< jobs in parallel; their inner loops share the same threads
    std::uint64_t memory = 0; ///< bytes for parallel jobs; a job that needs more runs alone
    /// If set, each job except a first takes a token, and its inner loops use a single thread.
    Jobserver* tokens = nullptr;
};

/// Calls work for all jobs, which start in order. work receives a function that returns whether other jobs
/// ran at the same time so far.
class Pool {
  public:
    using DoJob = std::function<Next(const Job&, const std::function<bool()>& beside_others)>;
    Pool(const PoolSettings& settings, std::vector<Job> jobs, DoJob work);
    /// Returns when all jobs are finished; after a stop, when the started jobs are.
    void run();

  private:
    /// A started job.
    struct Begun {
        Job job;
        bool has_token = false, others = false; ///< others: some were already running
        std::uint64_t number = 0;               ///< the number of jobs started before
    };
    using InArena = std::function<void(const std::function<void()>&)>;
    void take_jobs(const InArena& in_arena);
    bool fits(const Job& job) const;
    bool take_slot(bool& has_token);
    bool begin(Begun& begun); ///< waits for a job; false if none is left
    void end(const Begun& begun, Next next);

    const PoolSettings settings_;
    const DoJob work_;
    std::mutex guard_;
    std::condition_variable changed_;
    std::deque<Job> waiting_;
    int running_ = 0;
    bool alone_ = false, stopped_ = false;
    bool first_taken_ = false; ///< the job that needs no token is running
    std::uint64_t used_ = 0, begun_ = 0;
};

} // namespace facetmill::batch

#pragma once
// Runs jobs on shared threads, as far as cores and memory allow.

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
    bool alone = false;       ///< must run without other jobs
};

/// What to do after a job.
enum class Next {
    go_on,
    stop,        ///< starts no more jobs
    again_alone, ///< runs the job again, without other jobs
};

struct PoolSettings {
    int jobs = 1;             ///< concurrent jobs; loops inside jobs share this many threads
    std::uint64_t memory = 0; ///< bytes for concurrent jobs; a job that exceeds them runs alone
    /// If not null, each job except the first takes a token, and loops inside a job use only its thread.
    Jobserver* tokens = nullptr;
};

/// Calls work for all jobs, starting in order. work receives a function that returns whether other jobs have
/// run at the same time.
class Pool {
  public:
    using DoJob = std::function<Next(const Job&, const std::function<bool()>& beside_others)>;
    Pool(const PoolSettings& settings, std::vector<Job> jobs, DoJob work);
    /// Returns when all jobs have finished; after a stop, when the started jobs have finished.
    void run();

  private:
    /// A started job.
    struct Begun {
        Job job;
        bool has_token = false, others = false; ///< others: other jobs were already running
        std::uint64_t number = 0;               ///< how many had started
    };
    using InArena = std::function<void(const std::function<void()>&)>;
    void take_jobs(const InArena& in_arena);
    bool fits(const Job& job) const;
    bool take_slot(bool& has_token);
    bool begin(Begun& begun); ///< waits for a job; false when none is left
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

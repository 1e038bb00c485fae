#pragma once
// Jobs on shared threads, admitted as cores and memory allow.

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
    bool alone = false;       ///< nothing else runs meanwhile
};

/// The action after a job.
enum class Next {
    go_on,
    stop,        ///< nothing more begins
    again_alone, ///< the job is run again, alone
};

struct PoolSettings {
    int jobs = 1;             ///< at a time; loops inside jobs share this many threads, too
    std::uint64_t memory = 0; ///< bytes for the jobs that run at a time; one that exceeds them runs alone
    /// Not null: each job but one takes a token, and the loops inside a job have its one thread.
    Jobserver* tokens = nullptr;
};

/// Calls work for all jobs; they begin in their order. work gets whether others ran beside the job so far.
class Pool {
  public:
    using DoJob = std::function<Next(const Job&, const std::function<bool()>& beside_others)>;
    Pool(const PoolSettings& settings, std::vector<Job> jobs, DoJob work);
    /// Returns when all are done, or, after a stop, those that had begun.
    void run();

  private:
    /// A job that has begun.
    struct Begun {
        Job job;
        bool has_token = false, others = false; ///< others: some ran already
        std::uint64_t number = 0;               ///< how many had begun
    };
    using InArena = std::function<void(const std::function<void()>&)>;
    void take_jobs(const InArena& in_arena);
    bool fits(const Job& job) const;
    bool take_slot(bool& has_token);
    bool begin(Begun& begun); ///< waits for a job; false when no jobs are left
    void end(const Begun& begun, Next next);

    const PoolSettings settings_;
    const DoJob work_;
    std::mutex guard_;
    std::condition_variable changed_;
    std::deque<Job> waiting_;
    int running_ = 0;
    bool alone_ = false, stopped_ = false;
    bool first_taken_ = false; ///< the job that needs no token runs
    std::uint64_t used_ = 0, begun_ = 0;
};

} // namespace facetmill::batch

#include "batch/pool.hpp"

#include "batch/jobserver.hpp"

#include <algorithm>
#include <chrono>
#include <system_error>
#include <tbb/task_arena.h>
#include <thread>

namespace facetmill::batch {

Pool::Pool(const PoolSettings& settings, std::vector<Job> jobs, DoJob work)
    : settings_(settings), work_(std::move(work)), waiting_(jobs.begin(), jobs.end()) {}

bool Pool::fits(const Job& job) const {
    if (running_ == 0) return true;
    return !alone_ && !job.alone && used_ + job.memory <= settings_.memory;
}

bool Pool::take_slot(bool& has_token) {
    has_token = settings_.tokens && first_taken_;
    if (!has_token) first_taken_ = true;
    return !has_token || settings_.tokens->take();
}

bool Pool::begin(Begun& begun) {
    constexpr std::chrono::milliseconds between_looks(20); // returned tokens cause no notification
    std::unique_lock lock(guard_);
    while (true) {
        if (stopped_ || (waiting_.empty() && running_ == 0)) return false;
        if (!waiting_.empty() && fits(waiting_.front()) && take_slot(begun.has_token)) break;
        if (settings_.tokens && !waiting_.empty())
            changed_.wait_for(lock, between_looks);
        else
            changed_.wait(lock);
    }
    begun.job = waiting_.front();
    waiting_.pop_front();
    begun.others = running_++ > 0;
    begun.number = ++begun_;
    alone_ = begun.job.alone;
    used_ += begun.job.memory;
    return true;
}

void Pool::end(const Begun& begun, Next next) {
    const std::lock_guard lock(guard_);
    if (begun.has_token)
        settings_.tokens->give();
    else
        first_taken_ = false;
    --running_;
    alone_ = false;
    used_ -= begun.job.memory;
    stopped_ = stopped_ || next == Next::stop;
    if (next == Next::again_alone) waiting_.push_back({begun.job.index, begun.job.memory, true});
    changed_.notify_all();
}

void Pool::take_jobs(const InArena& in_arena) {
    Begun begun;
    while (begin(begun)) {
        const auto beside_others = [&] {
            const std::lock_guard lock(guard_);
            return begun.others || begun_ != begun.number;
        };
        Next next = Next::go_on;
        in_arena([&] { next = work_(begun.job, beside_others); });
        end(begun, next);
    }
}

void Pool::run() {
    // All jobs share an arena, so that their loops can use all free threads, but never more than the limit.
    // Jobs are isolated: while a job waits for its loops, its thread does not start work of another job.
    tbb::task_arena shared(settings_.jobs);
    const auto on_thread = [&] {
        tbb::task_arena own(1);
        tbb::task_arena& arena = settings_.tokens ? own : shared;
        take_jobs([&](const std::function<void()>& job) {
            arena.execute([&] { tbb::this_task_arena::isolate(job); });
        });
    };
    std::vector<std::thread> threads;
    const auto count = std::min(static_cast<std::size_t>(settings_.jobs), waiting_.size());
    threads.reserve(count);
    try {
        for (std::size_t t = 0; t < count; ++t) threads.emplace_back(on_thread);
    } catch (const std::system_error&) { // no further thread: the existing threads do all the work
        if (threads.empty()) throw;
    }
    for (auto& thread : threads) thread.join();
}

} // namespace facetmill::batch

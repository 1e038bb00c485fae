#include "platform/worker_pool.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace facetmill {

namespace {

constexpr std::chrono::milliseconds between_checks(100);

std::vector<WorkerPool*>& pools() {
    static std::vector<WorkerPool*> all;
    return all;
}

} // namespace

WorkerPool::WorkerPool() { pools().push_back(this); }

WorkerPool::~WorkerPool() { std::erase(pools(), this); }

void WorkerPool::start(int count, const std::function<void(const Descriptor&)>& serve) {
    const std::lock_guard lock(mutex_);
    if (!all_.empty()) return;
    for (int n = count; n > 0; --n) {
        Descriptor socket = start_worker([&](const Descriptor& served) {
            // Close inherited sockets, or other workers would not see that the client has ended.
            for (WorkerPool* pool : pools()) {
                pool->free_.clear();
                pool->all_.clear();
            }
            serve(served);
        });
        if (!socket) return;
        free_.push_back(all_.emplace_back(std::make_shared<const Descriptor>(std::move(socket))));
    }
}

void WorkerPool::for_each(const std::function<void(const Descriptor&)>& call) {
    const std::lock_guard lock(mutex_);
    for (const auto& socket : all_) call(*socket);
}

bool WorkerPool::order_ends(const Descriptor& socket) {
    char byte = 0;
    return receive_all(socket, &byte, sizeof byte);
}

WorkerPool::Loan::Loan(WorkerPool& pool, std::function<void()> check)
    : pool_(pool), check_(std::move(check)) {
    std::unique_lock lock(pool.mutex_);
    while (
        !pool.freed_.wait_for(lock, between_checks, [&] { return !pool.free_.empty() || pool.all_.empty(); }))
        check_();
    if (pool.free_.empty()) return;
    socket_ = std::move(pool.free_.back());
    pool.free_.pop_back();
}

void WorkerPool::Loan::wait() {
    while (!is_readable(*socket_, between_checks)) {
        if (given_up_) continue;
        try {
            check_();
        } catch (...) {
            given_up_ = std::current_exception();
            send_end();
        }
    }
}

void WorkerPool::Loan::end() {
    send_end();
    if (given_up_) std::rethrow_exception(given_up_);
}

void WorkerPool::Loan::send_end() {
    const char byte = 0;
    if (!std::exchange(end_sent_, true) && !send_all(*socket_, &byte, sizeof byte)) broken_ = true;
}

WorkerPool::Loan::~Loan() {
    if (!socket_) return;
    broken_ = broken_ || !end_sent_; // an exception came before the end of the answer
    {
        const std::lock_guard lock(pool_.mutex_);
        if (broken_)
            std::erase(pool_.all_, socket_);
        else
            pool_.free_.push_back(std::move(socket_));
    }
    pool_.freed_.notify_all();
}

} // namespace facetmill

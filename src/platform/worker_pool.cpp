#include "platform/worker_pool.hpp"

#include <algorithm>

namespace facetmill {

namespace {

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

WorkerPool::Loan::Loan(WorkerPool& pool) : pool_(pool) {
    std::unique_lock lock(pool.mutex_);
    pool.freed_.wait(lock, [&] { return !pool.free_.empty() || pool.all_.empty(); });
    if (pool.free_.empty()) return;
    socket_ = std::move(pool.free_.back());
    pool.free_.pop_back();
}

WorkerPool::Loan::~Loan() {
    if (!socket_) return;
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

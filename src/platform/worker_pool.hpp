#pragma once
// Worker processes that serve one request at a time. They start before the sandbox closes, because it
// forbids new processes.

#include "platform/worker_process.hpp"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <vector>

namespace facetmill {

class WorkerPool {
  public:
    WorkerPool();
    ~WorkerPool();
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    /// Starts workers unless some are running. Each runs the function with its end of a socket pair.
    void start(int count, const std::function<void(const Descriptor& socket)>& serve);

    /// A borrowed worker; waits for a free one. It returns to the pool unless it is dropped.
    class Loan {
      public:
        explicit Loan(WorkerPool& pool);
        ~Loan();
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;

        /// Null if no worker is running.
        [[nodiscard]] const Descriptor* socket() const { return socket_.get(); }
        /// The worker gave a broken answer: its socket closes, which ends it.
        void drop() { broken_ = true; }

      private:
        WorkerPool& pool_;
        std::shared_ptr<const Descriptor> socket_;
        bool broken_ = false;
    };

  private:
    std::mutex mutex_;
    std::condition_variable freed_;
    std::vector<std::shared_ptr<const Descriptor>> all_, free_; ///< sockets of all and of free workers
};

} // namespace facetmill

#pragma once
// Worker processes that serve one request at a time. They start before the sandbox closes, because it
// forbids new processes.

#include "platform/worker_process.hpp"

#include <condition_variable>
#include <exception>
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

    /// Calls the function with the socket of each worker. No worker may be on loan.
    void for_each(const std::function<void(const Descriptor& socket)>& call);

    /// For a worker, after its answer: waits for the byte that ends the order. If it came
    /// before the answer, the order was cancelled. False if the client has ended.
    [[nodiscard]] static bool order_ends(const Descriptor& socket);

    /// A borrowed worker for one order; waits for a free one. It returns to the pool unless it is dropped.
    class Loan {
      public:
        /// check is called several times a second while the loan waits, and may throw.
        Loan(WorkerPool& pool, std::function<void()> check);
        ~Loan();
        Loan(const Loan&) = delete;
        Loan& operator=(const Loan&) = delete;

        /// Null if no worker is running.
        [[nodiscard]] const Descriptor* socket() const { return socket_.get(); }
        /// Waits for a part of the answer. If the check throws, the worker gives the order up, and end()
        /// throws that exception.
        void wait();
        /// Call it after the last byte of the answer.
        void end();
        /// The worker gave a broken answer: its socket closes, which ends it.
        void drop() { broken_ = true; }

      private:
        void send_end();

        WorkerPool& pool_;
        std::function<void()> check_;
        std::shared_ptr<const Descriptor> socket_;
        std::exception_ptr given_up_;
        bool broken_ = false, end_sent_ = false;
    };

  private:
    std::mutex mutex_;
    std::condition_variable freed_;
    std::vector<std::shared_ptr<const Descriptor>> all_, free_; ///< sockets of all and of free workers
};

} // namespace facetmill

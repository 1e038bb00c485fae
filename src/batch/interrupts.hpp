#pragma once
// Handles SIGINT, SIGTERM and SIGHUP during a batch: calls a function before they end the process.

#include <csignal>
#include <functional>
#include <thread>

namespace facetmill::batch {

/// While one lives, these signals (but ignored ones: nohup) are kept from all threads that start. One that
/// arrives calls the function, on a thread of its own, and then ends the process as it would without a batch.
class Interrupts {
  public:
    explicit Interrupts(std::function<void()> on_signal);
    ~Interrupts();
    Interrupts(const Interrupts&) = delete;
    Interrupts& operator=(const Interrupts&) = delete;

  private:
    void watch();
    [[noreturn]] void end_by(int number) const;

    std::function<void()> on_signal_;
    sigset_t signals_{}, before_{};
    int arrived_ = -1, over_ = -1; ///< descriptors
    std::thread watcher_;
};

} // namespace facetmill::batch

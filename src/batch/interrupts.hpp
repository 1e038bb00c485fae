#pragma once
// Handles SIGINT, SIGTERM and SIGHUP during a batch: reports before the process ends.

#include <csignal>
#include <functional>
#include <thread>

namespace facetmill::batch {

/// During its lifetime, new threads block these signals, except ignored signals (nohup). An arriving signal
/// calls the function on a separate thread, and then ends the process as it would without a batch.
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

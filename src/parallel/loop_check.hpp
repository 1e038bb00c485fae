#pragma once
// Lets a run end its parallel loops early, for example after a time limit.

#include <functional>

namespace facetmill {

/// During its lifetime, the parallel loops of this thread call `check` before each chunk that this thread
/// runs. An exception of `check` ends the loop.
class LoopCheck {
  public:
    explicit LoopCheck(std::function<void()> check);
    ~LoopCheck();
    LoopCheck(const LoopCheck&) = delete;
    LoopCheck& operator=(const LoopCheck&) = delete;

  private:
    const std::function<void()> check_;
    const std::function<void()>* before_;
};

/// Calls the check of this thread's loops, for work outside of loops that waits. Does nothing without one.
void check_loop_now();

} // namespace facetmill

#pragma once
// SIGINT, SIGTERM and SIGHUP while something long runs: it learns of them before they end the process.

#include <functional>
#include <memory>

namespace facetmill {

/// While one lives, these signals (except ignored ones: nohup) are kept from all threads that start. One that
/// arrives calls the function, on a thread of its own, and then ends the process as it would have without.
class Interrupts {
  public:
    explicit Interrupts(std::function<void()> on_signal);
    ~Interrupts();
    Interrupts(const Interrupts&) = delete;
    Interrupts& operator=(const Interrupts&) = delete;

  private:
    class Watcher;
    std::unique_ptr<Watcher> watcher_;
};

} // namespace facetmill

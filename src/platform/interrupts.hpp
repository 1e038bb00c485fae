#pragma once
// Handles SIGINT, SIGTERM and SIGHUP during long operations, before they end the process.

#include <functional>
#include <memory>

namespace facetmill {

/// During its lifetime, new threads block these signals (except ignored ones: nohup). A signal calls the
/// function on a separate thread, and then ends the process as usual.
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

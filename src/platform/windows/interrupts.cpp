#include "platform/interrupts.hpp"

#include <mutex>
#include <windows.h>

namespace facetmill {

/// Windows calls the newest handler of control events first, on a thread of its own.
class Interrupts::Watcher {
  public:
    explicit Watcher(std::function<void()> on_signal) : on_signal_(std::move(on_signal)) {
        const std::lock_guard lock(guard);
        current = this;
        ::SetConsoleCtrlHandler(on_control, TRUE);
    }
    ~Watcher() {
        ::SetConsoleCtrlHandler(on_control, FALSE);
        const std::lock_guard lock(guard);
        current = nullptr;
    }
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;

  private:
    /// Returns false, so that the handler that ends the process follows (on_end_signals).
    static BOOL WINAPI on_control(DWORD) {
        const std::lock_guard lock(guard);
        if (current) current->on_signal_();
        return FALSE;
    }

    inline static std::mutex guard;
    inline static Watcher* current = nullptr;
    std::function<void()> on_signal_;
};

Interrupts::Interrupts(std::function<void()> on_signal)
    : watcher_(std::make_unique<Watcher>(std::move(on_signal))) {}

Interrupts::~Interrupts() = default;

} // namespace facetmill

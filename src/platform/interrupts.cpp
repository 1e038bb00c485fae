#include "platform/interrupts.hpp"

#include "platform/descriptor.hpp"

#include <array>
#include <chrono>
#include <csignal>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <thread>
#include <unistd.h>

namespace facetmill {

namespace {

bool is_ignored(int number) {
    struct sigaction action {};
    ::sigaction(number, nullptr, &action);
    return action.sa_handler == SIG_IGN;
}

} // namespace

class Interrupts::Watcher {
  public:
    explicit Watcher(std::function<void()> on_signal) : on_signal_(std::move(on_signal)) {
        sigemptyset(&signals_);
        for (const int number : {SIGINT, SIGTERM, SIGHUP})
            if (!is_ignored(number)) sigaddset(&signals_, number);
        ::pthread_sigmask(SIG_BLOCK, &signals_, &before_);
        arrived_ = Descriptor(::signalfd(-1, &signals_, SFD_CLOEXEC));
        over_ = Descriptor(::eventfd(0, EFD_CLOEXEC));
        thread_ = std::thread([this] { watch(); });
    }
    ~Watcher() {
        ::eventfd_write(over_.number(), 1);
        thread_.join();
        arrived_.close();
        over_.close();
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;

  private:
    void watch() {
        while (true) {
            std::array<pollfd, 2> events{{{arrived_.number(), POLLIN, 0}, {over_.number(), POLLIN, 0}}};
            if (::poll(events.data(), events.size(), -1) < 0) continue;
            signalfd_siginfo info{};
            if ((events[0].revents & POLLIN) &&
                ::read(arrived_.number(), &info, sizeof info) == sizeof info) {
                on_signal_();
                end_by(static_cast<int>(info.ssi_signo));
            }
            if (events[1].revents & POLLIN) return;
        }
    }

    [[noreturn]] void end_by(int number) const {
        ::pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
        while (true) {
            ::raise(number);
            // Another thread is renaming outputs; the handler lets it finish.
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    std::function<void()> on_signal_;
    sigset_t signals_{}, before_{};
    Descriptor arrived_, over_;
    std::thread thread_;
};

Interrupts::Interrupts(std::function<void()> on_signal)
    : watcher_(std::make_unique<Watcher>(std::move(on_signal))) {}

Interrupts::~Interrupts() = default;

} // namespace facetmill

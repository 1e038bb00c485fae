#include "batch/interrupts.hpp"

#include <array>
#include <chrono>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace facetmill::batch {

namespace {

bool is_ignored(int number) {
    struct sigaction action {};
    ::sigaction(number, nullptr, &action);
    return action.sa_handler == SIG_IGN;
}

} // namespace

Interrupts::Interrupts(std::function<void()> on_signal) : on_signal_(std::move(on_signal)) {
    sigemptyset(&signals_);
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        if (!is_ignored(number)) sigaddset(&signals_, number);
    ::pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    arrived_ = ::signalfd(-1, &signals_, SFD_CLOEXEC);
    over_ = ::eventfd(0, EFD_CLOEXEC);
    watcher_ = std::thread([this] { watch(); });
}

Interrupts::~Interrupts() {
    ::eventfd_write(over_, 1);
    watcher_.join();
    ::close(arrived_);
    ::close(over_);
    ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interrupts::watch() {
    while (true) {
        std::array<pollfd, 2> events{{{arrived_, POLLIN, 0}, {over_, POLLIN, 0}}};
        if (::poll(events.data(), events.size(), -1) < 0) continue;
        signalfd_siginfo info{};
        if ((events[0].revents & POLLIN) && ::read(arrived_, &info, sizeof info) == sizeof info) {
            on_signal_();
            end_by(static_cast<int>(info.ssi_signo));
        }
        if (events[1].revents & POLLIN) return;
    }
}

void Interrupts::end_by(int number) const {
    ::pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
    while (true) {
        ::raise(number);
        // Waits while another thread renames outputs; the handler lets the renaming finish.
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

} // namespace facetmill::batch

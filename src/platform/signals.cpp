#include "platform/signals.hpp"

#include <csignal>
#include <unistd.h>

namespace facetmill {

namespace {

void install(int number, SignalHandler handler) {
    struct sigaction before {
    }, action{};
    ::sigaction(number, nullptr, &before);
    if (before.sa_handler == SIG_IGN) return;
    action.sa_handler = handler;
    ::sigaction(number, &action, nullptr);
}

} // namespace

void on_end_signals(SignalHandler handler) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) install(number, handler);
}

void on_lost_pages(SignalHandler handler) { install(SIGBUS, handler); }

void ignore_write_signals() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void end_by(int number) noexcept {
    struct sigaction plain {};
    plain.sa_handler = SIG_DFL;
    ::sigaction(number, &plain, nullptr);
    ::raise(number);
}

void end_by_closed_pipe() noexcept { end_by(SIGPIPE); }

void raise_signal(int number) noexcept { ::raise(number); }

void wait_for_the_end() noexcept {
    while (true) ::pause();
}

void write_to_standard_error(std::string_view text) noexcept {
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

void exit_now(int code) noexcept { ::_exit(code); }

} // namespace facetmill

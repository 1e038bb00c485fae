#pragma once
// Signals that end the process, and what their handlers may do.

#include <string_view>

namespace facetmill {

using SignalHandler = void (*)(int number);

/// The handler of SIGINT, SIGTERM and SIGHUP. Signals that are ignored stay so (nohup).
void on_end_signals(SignalHandler handler);
/// ... of SIGBUS: a file has become shorter than its mapping.
void on_lost_pages(SignalHandler handler);
/// From now on writing to a closed pipe, or beyond a limit of sizes, fails with an error instead.
void ignore_write_signals();

// Safe in handlers:

/// Ends the process as the signal does that has no handler, so that its status is 128+number. In a handler it
/// takes effect at the handler's end.
void end_by(int number) noexcept;
/// ... as a filter ends whose reader went away.
void end_by_closed_pipe() noexcept;
void raise_signal(int number) noexcept;
[[noreturn]] void wait_for_the_end() noexcept;
void write_to_standard_error(std::string_view text) noexcept;
/// Without destructors and buffers.
[[noreturn]] void exit_now(int code) noexcept;

} // namespace facetmill

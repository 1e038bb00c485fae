#pragma once
// Signals that end the process, and functions for their handlers.

#include <string_view>

namespace facetmill {

using SignalHandler = void (*)(int number);

/// Sets the handler of SIGINT, SIGTERM and SIGHUP. Ignored signals stay ignored (nohup).
void on_end_signals(SignalHandler handler);
/// Sets the handler of SIGBUS: a mapped file was truncated.
void on_lost_pages(SignalHandler handler);
/// Makes writing to a closed pipe, or beyond a size limit, fail with an error instead of a signal.
void ignore_write_signals();

// The following functions are safe in handlers.

/// Ends the process like the unhandled signal, so that its status is 128+number. In a handler, it takes
/// effect when the handler returns.
void end_by(int number) noexcept;
/// Ends the process like a filter whose reader has closed the pipe.
void end_by_closed_pipe() noexcept;
void raise_signal(int number) noexcept;
[[noreturn]] void wait_for_the_end() noexcept;
void write_to_standard_error(std::string_view text) noexcept;
/// Ends without destructors and without flushing buffers.
[[noreturn]] void exit_now(int code) noexcept;

} // namespace facetmill

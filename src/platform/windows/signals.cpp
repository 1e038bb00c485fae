#include "platform/signals.hpp"

#include <atomic>
#include <windows.h>

namespace facetmill {

namespace {

/// The numbers of other systems, which exit codes contain.
constexpr int hangup = 1, interrupt = 2, lost_pages = 7, closed_pipe = 13, terminate = 15;
constexpr int first_code = 128;

std::atomic<SignalHandler> at_end{nullptr}, at_lost_pages{nullptr};

/// Windows calls it on a new thread.
BOOL WINAPI on_control(DWORD event) {
    const int number = event == CTRL_C_EVENT ? interrupt : event == CTRL_BREAK_EVENT ? terminate : hangup;
    raise_signal(number);
    // Another thread is renaming outputs, and ends the process afterwards. For the other events, the process
    // would end as soon as this function returns.
    if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT) wait_for_the_end();
    return TRUE;
}

LONG WINAPI on_exception(EXCEPTION_POINTERS* about) {
    const SignalHandler handler = at_lost_pages;
    if (about->ExceptionRecord->ExceptionCode == EXCEPTION_IN_PAGE_ERROR && handler) handler(lost_pages);
    return EXCEPTION_CONTINUE_SEARCH;
}

} // namespace

void on_end_signals(SignalHandler handler) {
    at_end = handler;
    ::SetConsoleCtrlHandler(on_control, TRUE);
}

void on_lost_pages(SignalHandler handler) {
    at_lost_pages = handler;
    ::AddVectoredExceptionHandler(0, on_exception);
}

/// Windows has no such signals.
void ignore_write_signals() {}

void end_by(int number) noexcept { exit_now(first_code + number); }

void end_by_closed_pipe() noexcept { end_by(closed_pipe); }

void raise_signal(int number) noexcept {
    if (const SignalHandler handler = at_end)
        handler(number);
    else
        end_by(number);
}

void wait_for_the_end() noexcept {
    while (true) ::Sleep(INFINITE);
}

void write_to_standard_error(std::string_view text) noexcept {
    DWORD written = 0;
    ::WriteFile(::GetStdHandle(STD_ERROR_HANDLE), text.data(), static_cast<DWORD>(text.size()), &written,
                nullptr);
}

void exit_now(int code) noexcept {
    ::TerminateProcess(::GetCurrentProcess(), static_cast<UINT>(code));
    wait_for_the_end();
}

} // namespace facetmill

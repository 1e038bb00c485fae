#include "io/outputs/clean_up.hpp"

#include "io/outputs/outputs.hpp"

#include <atomic>
#include <csignal>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <unistd.h>

namespace facetmill::io {

struct CleanUp {
    std::string path, aside{}; ///< aside: what is renamed to path; empty: path is removed
    bool directory = false;
    std::atomic<bool> active{true};
    CleanUp* next = nullptr;
};

namespace {

// Only lock-free atomics and async-signal-safe calls are used in the handler.
enum State : int { idle, held, dying };
std::atomic<int> state{idle};
std::atomic<std::thread::id> holder; ///< the last that held signals off
std::atomic<int> waiting_signal{0};
std::atomic<CleanUp*> entries{nullptr};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<CleanUp*>::is_always_lock_free);

[[noreturn]] void wait_for_the_end() {
    while (true) ::pause();
}

CleanUp* enter(std::string path, std::string aside, bool directory) {
    auto* entry = new CleanUp;
    entry->path = std::move(path);
    entry->aside = std::move(aside);
    entry->directory = directory;
    entry->next = entries.load();
    while (!entries.compare_exchange_weak(entry->next, entry)) {
    }
    // A handler on another thread may have walked the list already: nothing new may appear then.
    if (state == dying) wait_for_the_end();
    return entry;
}

void undo_all() {
    for (const CleanUp* e = entries; e; e = e->next)
        if (e->active && !e->directory) {
            if (e->aside.empty())
                ::unlink(e->path.c_str());
            else
                ::rename(e->aside.c_str(), e->path.c_str());
        }
    for (const CleanUp* e = entries; e; e = e->next) // the last made first
        if (e->active && e->directory) ::rmdir(e->path.c_str());
}

extern "C" void end_by_signal(int number) {
    int expected = idle;
    if (!state.compare_exchange_strong(expected, dying)) {
        if (expected == held) waiting_signal = number;
        return;
    }
    undo_all();
    // The default action makes the exit status 128+n; the signal is delivered when the handler returns.
    struct sigaction plain {};
    plain.sa_handler = SIG_DFL;
    ::sigaction(number, &plain, nullptr);
    ::raise(number);
}

extern "C" void end_by_lost_input(int number) {
    static const char message[] = "facetmill: error[E-FILE]: an input shrank while it was read\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message, sizeof message - 1);
    if (state != dying) undo_all();
    struct sigaction plain {};
    plain.sa_handler = SIG_DFL;
    ::sigaction(number, &plain, nullptr);
    ::raise(number);
}

void install(int number, void (*handler)(int)) {
    struct sigaction before {
    }, action{};
    ::sigaction(number, nullptr, &before);
    if (before.sa_handler == SIG_IGN) return;
    action.sa_handler = handler;
    ::sigaction(number, &action, nullptr);
}

} // namespace

CleanUp* clean_up_file(const std::filesystem::path& path) { return enter(path.string(), {}, false); }
CleanUp* clean_up_restore(const std::filesystem::path& aside, const std::filesystem::path& path) {
    return enter(path.string(), aside.string(), false);
}
CleanUp* clean_up_directory(const std::filesystem::path& path) { return enter(path.string(), {}, true); }
void keep(CleanUp* entry) {
    if (entry) entry->active = false;
}

void end_at_once(int exit_code, std::string_view message) {
    for (int expected = idle; !state.compare_exchange_strong(expected, dying); expected = idle) {
        if (expected == dying) wait_for_the_end();
        if (holder == std::this_thread::get_id()) return;
        std::this_thread::yield(); // another gives outputs their names: all of them or none
    }
    undo_all();
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, message.data(), message.size());
    ::_exit(exit_code);
}

namespace {
std::mutex holders; ///< runs of several threads commit one after another
}

HoldSignals::HoldSignals() {
    holders.lock();
    holder = std::this_thread::get_id();
    int expected = idle;
    if (!state.compare_exchange_strong(expected, held)) wait_for_the_end();
}

HoldSignals::~HoldSignals() {
    state = idle;
    if (const int number = waiting_signal.exchange(0)) ::raise(number);
    holders.unlock();
}

void clean_up_on_signals() {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) install(number, end_by_signal);
    install(SIGBUS, end_by_lost_input);
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

} // namespace facetmill::io

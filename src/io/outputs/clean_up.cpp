#include "io/outputs/clean_up.hpp"

#include "io/outputs/outputs.hpp"
#include "platform/file_names.hpp"
#include "platform/signals.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

namespace facetmill::io {

struct CleanUp {
    std::filesystem::path path, aside{}; ///< aside: the file to rename to `path`. Empty: remove `path`
    bool directory = false;
    std::atomic<bool> active{true};
    CleanUp* next = nullptr;
};

namespace {

// Only lock-free atomics and async-signal-safe calls are used in the handler.
enum State : int { idle, held, dying };
std::atomic<int> state{idle};
std::atomic<std::thread::id> holder; ///< the last thread that delayed signals
std::atomic<int> waiting_signal{0};
std::atomic<CleanUp*> entries{nullptr};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<CleanUp*>::is_always_lock_free);

CleanUp* enter(std::filesystem::path path, std::filesystem::path aside, bool directory) {
    auto* entry = new CleanUp;
    entry->path = std::move(path);
    entry->aside = std::move(aside);
    entry->directory = directory;
    entry->next = entries.load();
    while (!entries.compare_exchange_weak(entry->next, entry)) {
    }
    // A handler on another thread may have walked the list already, so no new file may appear.
    if (state == dying) wait_for_the_end();
    return entry;
}

void undo_all() {
    for (const CleanUp* e = entries; e; e = e->next)
        if (e->active && !e->directory) {
            if (e->aside.empty())
                remove_file(e->path);
            else
                rename_file(e->aside, e->path);
        }
    for (const CleanUp* e = entries; e; e = e->next) // newest first
        if (e->active && e->directory) remove_folder(e->path);
}

extern "C" void end_by_signal(int number) {
    int expected = idle;
    if (!state.compare_exchange_strong(expected, dying)) {
        if (expected == held) waiting_signal = number;
        return;
    }
    undo_all();
    end_by(number);
}

extern "C" void end_by_lost_input(int number) {
    write_to_standard_error("facetmill: error[E-FILE]: an input shrank while it was read\n");
    if (state != dying) undo_all();
    end_by(number);
}

} // namespace

CleanUp* clean_up_file(const std::filesystem::path& path) { return enter(path, {}, false); }
CleanUp* clean_up_restore(const std::filesystem::path& aside, const std::filesystem::path& path) {
    return enter(path, aside, false);
}
CleanUp* clean_up_directory(const std::filesystem::path& path) { return enter(path, {}, true); }
void keep(CleanUp* entry) {
    if (entry) entry->active = false;
}

void end_at_once(int exit_code, std::string_view message) {
    for (int expected = idle; !state.compare_exchange_strong(expected, dying); expected = idle) {
        if (expected == dying) wait_for_the_end();
        if (holder == std::this_thread::get_id()) return;
        std::this_thread::yield(); // another thread is renaming outputs, and must rename all of them
    }
    undo_all();
    write_to_standard_error(message);
    exit_now(exit_code);
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
    if (const int number = waiting_signal.exchange(0)) raise_signal(number);
    holders.unlock();
}

void clean_up_on_signals() {
    on_end_signals(end_by_signal);
    on_lost_pages(end_by_lost_input);
    ignore_write_signals();
}

} // namespace facetmill::io

#include "parallel/parallel.hpp"

#include "base/progress.hpp"
#include "parallel/loop_check.hpp"
#include "platform/cores.hpp"

#include <atomic>
#include <cstddef>
#include <memory>
#include <tbb/cache_aligned_allocator.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <thread>

namespace facetmill {

namespace {

/// The check of this thread's loops, or null.
thread_local const std::function<void()>* loop_check = nullptr;

/// Never destroyed: TBB may need a thread for the destruction, and a failure at the end of the process could
/// not be reported.
std::unique_ptr<tbb::global_control>& control = *new std::unique_ptr<tbb::global_control>;
int count = 0;
/// An arena for more threads than cores, because TBB's own arenas have only a thread per core. Never
/// destroyed, like `control`.
std::unique_ptr<tbb::task_arena>& wide = *new std::unique_ptr<tbb::task_arena>;

/// TBB first allocates memory under locks that it needs again to report a failure, which would deadlock
/// (oneTBB 2022). So its allocator is tested first, without these locks, for pieces of its usual sizes, and
/// the system for more than their total. TBB then starts, and never ends.
void begin_tbb() {
    static tbb::task_arena* kept = nullptr;
    if (kept) return;
    tbb::cache_aligned_allocator<std::byte> memory;
    for (std::size_t bytes = 64; bytes <= std::size_t{1} << 20; bytes *= 2)
        memory.deallocate(memory.allocate(bytes), bytes);
    void* volatile room =
        ::operator new (std::size_t{8} << 20); // volatile, so that the compiler does not remove it
    ::operator delete(room);
    kept = new tbb::task_arena(1);
    kept->initialize();
}

/// Whether a loop of this thread would have fewer threads than requested. An arena with a single thread is
/// intended, for a job of a batch.
bool is_in_narrow_arena() {
    const int here = tbb::this_task_arena::max_concurrency();
    return wide && here > 1 && here < count;
}

} // namespace

void set_threads(int wanted) {
    begin_tbb();
    count = wanted > 0 ? wanted : default_threads();
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(count));
    wide.reset();
    if (count <= tbb::info::default_concurrency()) return;
    wide = std::make_unique<tbb::task_arena>(count);
    wide->initialize();
}

int threads() { return count > 0 ? count : tbb::info::default_concurrency(); }

void run_chunks(std::size_t n, std::size_t chunk, void* body, void (*call)(void*, std::size_t, std::size_t)) {
    const std::size_t chunks = (n + chunk - 1) / chunk;
    const auto* const check = loop_check;
    if (chunks <= 1) {
        if (check) (*check)();
        if (n > 0) call(body, 0, n);
        return;
    }
    // An error in an enclosing loop must not end this loop early, or its caller would continue with the
    // result of only some chunks.
    tbb::task_group_context whole(tbb::task_group_context::isolated);
    const auto run = [&](auto&& one) {
        const auto loop = [&] {
            tbb::parallel_for(std::size_t{0}, chunks, one, tbb::simple_partitioner{}, whole);
        };
        is_in_narrow_arena() ? wide->execute(loop) : loop();
    };
    const auto caller = std::this_thread::get_id();
    const auto work = [&](std::size_t c) {
        if (check && std::this_thread::get_id() == caller) (*check)();
        call(body, c * chunk, std::min(n, (c + 1) * chunk));
    };
    const ProgressScope::Range place = ProgressScope::of_loop();
    if (!place.to) return run(work); // otherwise only the caller reports, so progress never falls
    std::atomic<std::size_t> done = 0;
    {
        const ProgressScope silent(nullptr); // silences progress reports of the chunks
        run([&](std::size_t c) {
            work(c);
            const std::size_t now = done.fetch_add(1, std::memory_order_relaxed) + 1;
            if (std::this_thread::get_id() == caller)
                place.report(static_cast<double>(now) / static_cast<double>(chunks));
        });
    }
    place.report(1);
}

LoopCheck::LoopCheck(std::function<void()> check)
    : check_(std::move(check)), before_(std::exchange(loop_check, &check_)) {}

LoopCheck::~LoopCheck() { loop_check = before_; }

void check_loop_now() {
    if (loop_check) (*loop_check)();
}

void sort_few(std::span<KeyedPlace> places) {
    std::sort(places.begin(), places.end(), [](const KeyedPlace& a, const KeyedPlace& b) {
        return a.key != b.key ? a.key < b.key : a.place < b.place;
    });
}

} // namespace facetmill

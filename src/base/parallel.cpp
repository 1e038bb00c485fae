#include "base/parallel.hpp"

#include "base/cores.hpp"

#include <memory>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>

namespace facetmill {

namespace {

/// Never destroyed: TBB may want a thread for that, and at the end of the process nobody could be told that
/// there is none.
std::unique_ptr<tbb::global_control>& control = *new std::unique_ptr<tbb::global_control>;
int count = 0;

} // namespace

void set_threads(int wanted) {
    count = wanted > 0 ? wanted : default_threads();
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(count));
}

int threads() { return count > 0 ? count : tbb::info::default_concurrency(); }

void run_chunks(std::size_t n, std::size_t chunk, void* body, void (*call)(void*, std::size_t, std::size_t)) {
    const std::size_t chunks = (n + chunk - 1) / chunk;
    if (chunks <= 1) {
        if (n > 0) call(body, 0, n);
        return;
    }
    tbb::parallel_for(
        std::size_t{0}, chunks, [&](std::size_t c) { call(body, c * chunk, std::min(n, (c + 1) * chunk)); },
        tbb::simple_partitioner{});
}

void sort_few(std::span<KeyedPlace> places) {
    std::sort(places.begin(), places.end(), [](const KeyedPlace& a, const KeyedPlace& b) {
        return a.key != b.key ? a.key < b.key : a.place < b.place;
    });
}

} // namespace facetmill

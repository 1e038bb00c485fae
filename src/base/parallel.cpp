#include "base/parallel.hpp"

#include "base/cores.hpp"

#include <memory>
#include <tbb/global_control.h>
#include <tbb/info.h>

namespace facetmill {

namespace {
std::unique_ptr<tbb::global_control> control;
int count = 0;
} // namespace

void set_threads(int wanted) {
    count = wanted > 0 ? wanted : default_threads();
    control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                    static_cast<std::size_t>(count));
}

int threads() { return count > 0 ? count : tbb::info::default_concurrency(); }

} // namespace facetmill

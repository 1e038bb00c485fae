// All properties of a scan but self-intersections.

#include "geometry/inspect/inspect.hpp"
#include "support/meshes.hpp"

#include <benchmark/benchmark.h>

using namespace facetmill;

namespace {

void inspect_scan(benchmark::State& state) {
    const Mesh& mesh = bench::closed_scan();
    for (auto _ : state) benchmark::DoNotOptimize(inspect(mesh).euler);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(inspect_scan)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

} // namespace

// All pairs of faces of a scan that intersect, exactly; beside CGAL.

#include "geometry/intersect/self_intersections.hpp"
#include "support/cgal_surface.hpp"
#include "support/meshes.hpp"

#include <benchmark/benchmark.h>

using namespace facetmill;

namespace {

void self_intersections_scan(benchmark::State& state) {
    const Mesh& mesh = bench::closed_scan();
    for (auto _ : state) benchmark::DoNotOptimize(find_self_intersections(mesh, {.limit = 0}).count);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(self_intersections_scan)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void self_intersections_scan_cgal(benchmark::State& state) {
    const bench::CgalSurface surface(bench::closed_scan());
    for (auto _ : state) benchmark::DoNotOptimize(surface.self_intersections());
}
BENCHMARK(self_intersections_scan_cgal)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace

// Clipping and sectioning a closed scan: an oblique plane through its centre, with cap.

#include "geometry/clip/clip.hpp"
#include "geometry/section/section.hpp"
#include "support/meshes.hpp"

#include <benchmark/benchmark.h>

using namespace facetmill;

namespace {

Plane oblique(const Mesh& mesh) {
    Plane plane;
    plane.normal = {1, 0.7, 0.3};
    plane.through = mesh.bounds().centre();
    return plane;
}

/// What clip does to a mesh that it is given; the copy is not measured.
void clip_scan(benchmark::State& state, Keep keep, bool cap) {
    const Mesh& scan = bench::closed_scan();
    ClipSettings settings;
    settings.planes = {oblique(scan)};
    settings.keep = keep;
    settings.cap = cap;
    for (auto _ : state) {
        state.PauseTiming();
        Mesh mesh = scan;
        state.ResumeTiming();
        const ClipResult result = clip(std::move(mesh), settings);
        benchmark::DoNotOptimize(result.front.corners.data());
        state.PauseTiming();
        state.counters["cap_faces"] = static_cast<double>(result.cap_faces);
        state.ResumeTiming();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scan.face_count()));
}
BENCHMARK_CAPTURE(clip_scan, front_cap, Keep::front, true)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(clip_scan, front_open, Keep::front, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(clip_scan, both_cap, Keep::both, true)->Unit(benchmark::kMillisecond)->UseRealTime();

void section_scan(benchmark::State& state) {
    const Mesh& scan = bench::closed_scan();
    SectionSettings settings;
    settings.plane = oblique(scan);
    const double reach = 0.35 * scan.bounds().diagonal();
    settings.heights.clear();
    const auto count = static_cast<int>(state.range(0));
    for (int i = 0; i < count; ++i)
        settings.heights.push_back(count == 1 ? 0 : reach * (2.0 * i / (count - 1) - 1));
    for (auto _ : state) benchmark::DoNotOptimize(section(scan, settings).size());
}
BENCHMARK(section_scan)->Arg(1)->Arg(100)->Unit(benchmark::kMillisecond)->UseRealTime();

} // namespace

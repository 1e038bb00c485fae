// Simplification of a closed scan (bench/support/meshes.hpp). bench/compare/simplify.py sets peers beside it.

#include "geometry/simplify/simplify.hpp"
#include "support/meshes.hpp"

#include <benchmark/benchmark.h>

using namespace facetmill;

namespace {

using Method = SimplifySettings::Method;

/// To range(0) per mille of the faces.
void simplify_by(benchmark::State& state, Method method) {
    const Mesh& mesh = bench::closed_scan();
    for (auto _ : state)
        benchmark::DoNotOptimize(
            simplify(mesh, {.method = method, .ratio = static_cast<double>(state.range(0)) / 1000})
                .faces_after);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK_CAPTURE(simplify_by, quadric, Method::quadric)
    ->Arg(500)
    ->Arg(100)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simplify_by, quadric_endpoints, Method::quadric_endpoints)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simplify_by, shortest_edge, Method::shortest_edge)->Arg(100)->Unit(benchmark::kMillisecond);

/// Spheres of 20 * 4^levels faces, to a tenth: how the time grows.
void simplify_growth(benchmark::State& state) {
    CrumpleSettings rough;
    rough.amplitude = 1e-4;
    const Mesh mesh = crumple(shapes::icosphere(static_cast<int>(state.range(0))), rough).mesh;
    for (auto _ : state) benchmark::DoNotOptimize(simplify(mesh, {.ratio = 0.1}).faces_after);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(simplify_growth)->DenseRange(5, 8)->Unit(benchmark::kMillisecond);

} // namespace

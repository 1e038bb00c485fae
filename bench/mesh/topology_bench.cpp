// What every stage asks for first: the edges of a mesh, and the faces around vertices.

#include "mesh/shapes.hpp"
#include "mesh/topology.hpp"

#include <benchmark/benchmark.h>

using namespace facetmill;

namespace {

/// Spheres of 20 * 4^levels faces.
void edges(benchmark::State& state) {
    const Mesh mesh = shapes::icosphere(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(build_edges(mesh).size());
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(edges)->Arg(6)->Arg(8)->Unit(benchmark::kMillisecond);

void corners(benchmark::State& state) {
    const Mesh mesh = shapes::icosphere(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(corners_at_vertices(mesh).items.size());
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(corners)->Arg(6)->Arg(8)->Unit(benchmark::kMillisecond);

} // namespace

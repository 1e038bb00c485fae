// Midpoint splitting, four faces for one, beside OpenMesh's on a mesh that it has built already; the other
// methods; and the cost against the number of faces.

#include "geometry/split/split.hpp"
#include "support/meshes.hpp"
#include "support/openmesh.hpp"

#include <OpenMesh/Tools/Subdivider/Uniform/MidpointT.hh>
#include <benchmark/benchmark.h>

using namespace facetmill;

namespace {

void split_scan(benchmark::State& state, SplitMethod method) {
    const Mesh& mesh = bench::closed_scan();
    SplitSettings settings;
    settings.method = method;
    for (auto _ : state) benchmark::DoNotOptimize(split(mesh, settings).added);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK_CAPTURE(split_scan, midpoint, SplitMethod::midpoint)->Apply(bench::as_process);
BENCHMARK_CAPTURE(split_scan, bisect, SplitMethod::bisect)->Apply(bench::as_process);
BENCHMARK_CAPTURE(split_scan, centroid, SplitMethod::centroid)->Apply(bench::as_process);
BENCHMARK_CAPTURE(split_scan, loop, SplitMethod::loop)->Apply(bench::as_process);

void split_scan_openmesh(benchmark::State& state) {
    using Theirs = bench::OpenMeshTriangles;
    const Mesh& mesh = bench::closed_scan();
    const Theirs theirs = bench::to_openmesh(mesh);
    for (auto _ : state) {
        state.PauseTiming();
        Theirs copy = theirs;
        OpenMesh::Subdivider::Uniform::MidpointT<Theirs> midpoint;
        state.ResumeTiming();
        midpoint.attach(copy);
        midpoint(1);
        midpoint.detach();
        benchmark::DoNotOptimize(copy.n_faces());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(split_scan_openmesh)->Apply(bench::as_process);

/// Spheres of 20 * 4^levels faces: the time for a face is to stay the same.
void split_sphere(benchmark::State& state) {
    const Mesh mesh = shapes::icosphere(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(split(mesh, {}).added);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(split_sphere)->DenseRange(6, 10)->Apply(bench::as_process);

} // namespace

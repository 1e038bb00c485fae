// Midpoint splitting, four faces for one, beside OpenMesh's on a mesh that it has built already; the other
// methods; and the cost against the number of faces.

#include "geometry/split.hpp"
#include "support/meshes.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
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
BENCHMARK_CAPTURE(split_scan, midpoint, SplitMethod::midpoint)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(split_scan, bisect, SplitMethod::bisect)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(split_scan, centroid, SplitMethod::centroid)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(split_scan, loop, SplitMethod::loop)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void split_scan_openmesh(benchmark::State& state) {
    using Theirs = OpenMesh::TriMesh_ArrayKernelT<>;
    const Mesh& mesh = bench::closed_scan();
    Theirs theirs;
    for (const Vec3& p : mesh.positions)
        theirs.add_vertex({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    const auto vertex = [&](Index c) { return Theirs::VertexHandle(static_cast<int>(mesh.vertex(c))); };
    for (Index c = 0; c < mesh.corner_count(); c += 3)
        theirs.add_face(vertex(c), vertex(c + 1), vertex(c + 2));
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
BENCHMARK(split_scan_openmesh)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// Spheres of 20 * 4^levels faces: the time for a face is to stay the same.
void split_sphere(benchmark::State& state) {
    const Mesh mesh = shapes::icosphere(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(split(mesh, {}).added);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(split_sphere)
    ->DenseRange(6, 10)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace

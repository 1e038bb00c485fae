// Ten iterations of relaxation, neighbours found anew each time, beside OpenMesh's Jacobi smoother on a mesh
// that it has built already; and the cost against the number of faces.

#include "geometry/relax.hpp"
#include "support/meshes.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <benchmark/benchmark.h>

using namespace facetmill;
using Method = RelaxSettings::Method;

namespace {

RelaxSettings ten(Method method) {
    RelaxSettings s;
    s.method = method, s.iterations = 10;
    return s;
}

void relax_scan(benchmark::State& state, Method method) {
    const Mesh& mesh = bench::closed_scan();
    for (auto _ : state) benchmark::DoNotOptimize(relax(mesh, ten(method)).moved);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK_CAPTURE(relax_scan, laplacian, Method::laplacian)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(relax_scan, taubin, Method::taubin)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(relax_scan, cotangent, Method::cotangent)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK_CAPTURE(relax_scan, hc, Method::hc)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void relax_scan_openmesh(benchmark::State& state) {
    using Theirs = OpenMesh::TriMesh_ArrayKernelT<>;
    const Mesh& mesh = bench::closed_scan();
    Theirs theirs;
    for (const Vec3& p : mesh.positions)
        theirs.add_vertex({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    const auto vertex = [&](Index c) { return Theirs::VertexHandle(static_cast<int>(mesh.vertex(c))); };
    for (Index c = 0; c < mesh.corner_count(); c += 3)
        theirs.add_face(vertex(c), vertex(c + 1), vertex(c + 2));
    theirs.request_vertex_normals();
    theirs.request_face_normals();
    theirs.update_normals();
    using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<Theirs>;
    for (auto _ : state) {
        Smoother smoother(theirs);
        smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
        smoother.smooth(10);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(relax_scan_openmesh)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

/// Spheres of 20 * 4^levels faces: the time for a face is to stay the same.
void relax_sphere(benchmark::State& state) {
    const Mesh mesh = shapes::icosphere(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(relax(mesh, ten(Method::laplacian)).moved);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(relax_sphere)
    ->DenseRange(6, 10)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace

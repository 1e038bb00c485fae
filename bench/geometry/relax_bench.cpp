// Ten iterations of relaxation, neighbours found anew each time, beside OpenMesh's Jacobi smoother on a mesh
// that it has built already; and the cost against the number of faces.

#include "geometry/relax/relax.hpp"
#include "support/meshes.hpp"
#include "support/openmesh.hpp"

#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>
#include <benchmark/benchmark.h>

using namespace facetmill;
using Method = RelaxSettings::Method;

namespace {

RelaxSettings ten(Method method) {
    RelaxSettings s;
    s.method = method;
    s.iterations = 10;
    return s;
}

void relax_scan(benchmark::State& state, Method method) {
    const Mesh& mesh = bench::closed_scan();
    for (auto _ : state) benchmark::DoNotOptimize(relax(mesh, ten(method)).moved);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK_CAPTURE(relax_scan, laplacian, Method::laplacian)->Apply(bench::as_process);
BENCHMARK_CAPTURE(relax_scan, taubin, Method::taubin)->Apply(bench::as_process);
BENCHMARK_CAPTURE(relax_scan, cotangent, Method::cotangent)->Apply(bench::as_process);
BENCHMARK_CAPTURE(relax_scan, hc, Method::hc)->Apply(bench::as_process);

void relax_scan_openmesh(benchmark::State& state) {
    using Theirs = bench::OpenMeshTriangles;
    const Mesh& mesh = bench::closed_scan();
    Theirs theirs = bench::to_openmesh(mesh);
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
BENCHMARK(relax_scan_openmesh)->Apply(bench::as_process);

/// Spheres of 20 * 4^levels faces: the time for a face is to stay the same.
void relax_sphere(benchmark::State& state) {
    const Mesh mesh = shapes::icosphere(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(relax(mesh, ten(Method::laplacian)).moved);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(mesh.face_count()));
}
BENCHMARK(relax_sphere)->DenseRange(6, 10)->Apply(bench::as_process);

} // namespace

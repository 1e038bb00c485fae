// Probes of a large mesh: closest points, inside or outside, segments, and the tree that finds them; beside
// CGAL.

#include "base/math/random.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/probe/probe.hpp"
#include "support/cgal_surface.hpp"
#include "support/meshes.hpp"

#include <benchmark/benchmark.h>

using namespace facetmill;

namespace {

/// A million points near the surface, or anywhere in its box.
std::vector<Vec3> queries(const Surface& surface, bool near) {
    std::vector<Vec3> points;
    const Box box = surface.bounds();
    const Vec3 size = box.extent();
    const auto random = [](std::uint64_t key) { return uniform(hashed(3, key)); };
    std::uint64_t key = 0;
    for (const auto& sample : sample_area(surface, 1000000, 1)) {
        const Vec3 r{random(key), random(key + 1), random(key + 2)};
        key += 3;
        points.push_back(near ? sample.point + (r - Vec3{0.5, 0.5, 0.5}) * (0.01 * box.diagonal())
                              : box.min + Vec3{r.x * size.x, r.y * size.y, r.z * size.z});
    }
    return points;
}

void tree(benchmark::State& state) {
    const Surface surface = surface_of(bench::closed_scan());
    for (auto _ : state) benchmark::DoNotOptimize(FaceTree(surface).nodes.size());
}
BENCHMARK(tree)->Name("face_tree")->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();

void million(benchmark::State& state) {
    const Surface surface = surface_of(bench::closed_scan());
    const FaceTree tree(surface);
    const auto points = queries(surface, state.range(0) != 0);
    for (auto _ : state) benchmark::DoNotOptimize(closest_points(tree, points).data());
    state.SetItemsProcessed(state.iterations() * 1000000);
}
BENCHMARK(million)
    ->Name("closest_points/near")
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(million)
    ->Name("closest_points/anywhere")
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void sides(benchmark::State& state) {
    const Surface surface = surface_of(bench::closed_scan());
    const FaceTree tree(surface);
    const auto points = queries(surface, state.range(0) != 0);
    for (auto _ : state) benchmark::DoNotOptimize(probe_points(tree, points).data());
}
BENCHMARK(sides)
    ->Name("probe_points/near")
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(sides)
    ->Name("probe_points/anywhere")
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void segments(benchmark::State& state) {
    const Surface surface = surface_of(bench::closed_scan());
    const FaceTree tree(surface);
    const auto points = queries(surface, false);
    std::vector<Line> lines;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) lines.push_back({points[i], points[i + 1], false});
    for (auto _ : state) benchmark::DoNotOptimize(hits_of(tree, lines, state.range(0) != 0).hits.size());
}
BENCHMARK(segments)
    ->Name("segments/first")
    ->Arg(0)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(segments)
    ->Name("segments/all")
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void cgal_tree(benchmark::State& state) {
    bench::CgalSurface surface(bench::closed_scan());
    for (auto _ : state) surface.build_tree();
}
BENCHMARK(cgal_tree)
    ->Name("face_tree/cgal")
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void cgal_closest(benchmark::State& state) {
    bench::CgalSurface surface(bench::closed_scan());
    surface.build_tree();
    const auto points = queries(surface_of(bench::closed_scan()), state.range(0) != 0);
    for (auto _ : state) benchmark::DoNotOptimize(surface.distances(points));
}
BENCHMARK(cgal_closest)
    ->Name("closest_points/near/cgal")
    ->Arg(1)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void cgal_segments(benchmark::State& state) {
    bench::CgalSurface surface(bench::closed_scan());
    surface.build_tree();
    const auto points = queries(surface_of(bench::closed_scan()), false);
    for (auto _ : state) benchmark::DoNotOptimize(surface.met(points));
}
BENCHMARK(cgal_segments)
    ->Name("segments/any/cgal")
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace

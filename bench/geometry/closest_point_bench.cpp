// Closest points on a large mesh, and the tree that finds them.

#include "base/random.hpp"
#include "geometry/closest_point.hpp"
#include "geometry/deviation.hpp"
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
BENCHMARK(tree)->Name("face_tree")->Unit(benchmark::kMillisecond);

void million(benchmark::State& state) {
    const Surface surface = surface_of(bench::closed_scan());
    const FaceTree tree(surface);
    const auto points = queries(surface, state.range(0) != 0);
    for (auto _ : state) benchmark::DoNotOptimize(closest_points(tree, points).data());
    state.SetItemsProcessed(state.iterations() * 1000000);
}
BENCHMARK(million)->Name("closest_points/near")->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(million)->Name("closest_points/anywhere")->Arg(0)->Unit(benchmark::kMillisecond);

} // namespace

#include "geometry/relax.hpp"

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/parallel.hpp"
#include "geometry/moved.hpp"
#include "geometry/neighbours.hpp"

namespace facetmill {

namespace {

void check(const RelaxSettings& s) {
    if (s.iterations < 0)
        throw Error(ErrorKind::usage, "E-RANGE",
                    "relax: iterations is at least 0, not " + std::to_string(s.iterations));
    if (!(s.factor > 0 && s.factor <= 1))
        throw Error(ErrorKind::usage, "E-RANGE", "relax: factor is 0 < x <= 1, not " + spelled(s.factor));
}

/// One simultaneous step: to = from moved towards the neighbours' mean.
void step(const std::vector<Vec3>& from, std::vector<Vec3>& to, const VertexLists& near, double factor) {
    parallel_for(from.size(), [&](std::size_t v) {
        const auto others = near.of(static_cast<Index>(v));
        if (others.empty()) {
            to[v] = from[v];
            return;
        }
        Vec3 sum;
        for (const Index o : others) sum += from[o];
        const Vec3 mean = sum / static_cast<double>(others.size());
        to[v] = factor == 1 ? mean : from[v] + (mean - from[v]) * factor;
    });
}

struct Moves {
    double largest = 0; ///< squared
    std::size_t count = 0;
};

Moves compare(const std::vector<Vec3>& before, const std::vector<Vec3>& after) {
    return parallel_reduce(
        before.size(), Moves{},
        [&](std::size_t begin, std::size_t end) {
            Moves m;
            for (std::size_t v = begin; v < end; ++v) {
                const Vec3 d = after[v] - before[v];
                m.largest = std::max(m.largest, dot(d, d));
                m.count += after[v] != before[v];
            }
            return m;
        },
        [](Moves a, Moves b) {
            return Moves{std::max(a.largest, b.largest), a.count + b.count};
        });
}

} // namespace

RelaxResult relax(Mesh mesh, const RelaxSettings& settings) {
    check(settings);
    RelaxResult result;
    const Neighbourhoods near = neighbourhoods(mesh, settings);
    result.held = near.held;
    std::vector<Vec3> now = mesh.positions, next(now.size());
    for (std::int64_t i = 0; i < settings.iterations; ++i) {
        step(now, next, near.lists, settings.factor);
        now.swap(next);
    }
    const Moves moves = compare(mesh.positions, now);
    result.largest_move = std::sqrt(moves.largest);
    result.moved = moves.count;
    mesh.positions = std::move(now);
    result.fates = settle_moved(mesh);
    result.mesh = std::move(mesh);
    return result;
}

} // namespace facetmill

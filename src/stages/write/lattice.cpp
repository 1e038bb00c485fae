#include "stages/write/lattice.hpp"

#include "base/math/numbers.hpp"
#include "base/math/portable_math.hpp"
#include "base/math/whole_number.hpp"
#include "mesh/first_of_equal.hpp"
#include "mesh/position_hash.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

namespace facetmill::write_stage {

namespace {

double steps_of(int bits) { return std::ldexp(1.0, bits) - 1; }

/// The step of the scene's grid: longest side / (2^bits - 1), made 1e-4 to 2e-4 longer so that the number of
/// steps fits. It has five digits, so that grid coordinates are short too.
double step_of_scene(double whole, int bits) {
    const double step = whole / steps_of(bits) * (1 + 2e-4);
    return parse_real(fmt::format("{:.4e}", step)).value_or(step);
}

/// An upper bound for the stretch of a transform. It is exact for similarities, and nearly exact for rounded
/// similarities. The largest eigenvalue of a symmetric matrix is at most the largest sum of absolute values
/// in a row.
double stretch_of(const Transform& t) {
    const Vec3 axes[3] = {t.vector({1, 0, 0}), t.vector({0, 1, 0}), t.vector({0, 0, 1})};
    double most = 0;
    for (const Vec3& a : axes) {
        double sum = 0;
        for (const Vec3& b : axes) sum += std::abs(dot(a, b));
        most = std::max(most, sum);
    }
    return most > 0 ? std::sqrt(most) : 1;
}

/// The uniform scale of a transform without rotation or shear; 0 for other transforms.
double plain_scale(const Transform& t) {
    const double scale = t.m[0][0];
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            if (t.m[r][c] != (r == c ? scale : 0)) return 0;
    return scale > 0 ? scale : 0;
}

/// The origin of a part's grid. If the node only scales uniformly and moves, it is the last world grid point
/// not above the bounds. For other parts it is the part's own origin.
Vec3 origin_of(const Part& part, const Box& box, double step, bool in_world) {
    const double scale = in_world ? plain_scale(part.transform) : 0;
    constexpr double exact = 0x1p44; // doubles represent this many steps exactly
    Vec3 origin;
    for (std::size_t c = 0; c < 3; ++c) {
        double moved = scale > 0 ? part.transform.m[c][3] / scale : 0;
        if (!(std::abs(moved) + std::abs(box.min[c]) < exact * step)) moved = 0;
        origin[c] = std::floor((box.min[c] + moved) / step) * step - moved;
    }
    return origin;
}

using Place = std::array<std::int64_t, 3>;

/// Counts the distinct grid points after rounding.
std::size_t places_on(const Mesh& mesh, const io::Lattice& lattice) {
    std::vector<Place> places(mesh.vertex_count());
    parallel_for(places.size(), [&](std::size_t v) {
        for (std::size_t c = 0; c < 3; ++c)
            places[v][c] = whole_number<std::int64_t>(
                std::floor((mesh.positions[v][c] - lattice.origin[c]) / lattice.step + 0.5));
    });
    const auto hash = [&](Index v) {
        const auto [x, y, z] = places[v];
        return place_hash(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y),
                          static_cast<std::uint64_t>(z));
    };
    const auto equal = [&](Index v, Index w) { return places[v] == places[w]; };
    const std::vector<Index> first = first_of_equal(places.size(), hash, equal);
    std::size_t count = 0;
    for (std::size_t v = 0; v < first.size(); ++v) count += first[v] == v;
    return count;
}

/// The first of step, step / 2, step / 4 ... that keeps vertices distinct. Returns the step itself if only
/// steps below `least` would.
double step_apart(const Part& part, const Box& box, double step, double least, bool in_world) {
    if (!(box.longest_side() > 0)) return step;
    const std::size_t wanted = places_on(part.mesh, {box.min, box.longest_side() * 0x1p-40});
    for (double finer = step;; finer /= 2) {
        if (finer < box.longest_side() &&
            places_on(part.mesh, {origin_of(part, box, finer, in_world), finer}) == wanted)
            return finer;
        if (finer / 2 < least) return step;
    }
}

/// [parts] also true for parts that share the mesh of a document with a marked one.
std::vector<bool> with_shared_meshes(const Scene& scene, std::vector<bool> marked) {
    const auto mesh = [&](std::size_t i) {
        return std::pair(scene.parts[i].document, scene.parts[i].source_mesh);
    };
    std::set<std::pair<int, int>> meshes;
    for (std::size_t i = 0; i < marked.size(); ++i)
        if (marked[i]) meshes.insert(mesh(i));
    for (std::size_t i = 0; i < marked.size(); ++i)
        marked[i] = marked[i] || (mesh(i).second >= 0 && meshes.contains(mesh(i)));
    return marked;
}

/// The box that a part's grid numbers cover, from their origin. Under Draco, parts with a grid of the world
/// have the box of the whole scene.
Box box_on_grid(const Part& part, const Box& world, double step, bool in_world, bool draco) {
    Box box = part.mesh.bounds();
    const double scale = in_world && draco ? plain_scale(part.transform) : 0;
    if (scale > 0) {
        const auto back = [&](const Vec3& p) { return (p - part.transform.point({})) / scale; };
        return {back(world.min), back(world.max)};
    }
    box.min = origin_of(part, box, step, in_world);
    return box;
}

/// The fewest bits whose steps of this length cover the given length.
int bits_for(double length, double step, int most) {
    int bits = 1;
    while (bits < most && steps_of(bits) * step < length) ++bits;
    return bits;
}

} // namespace

DistinctParts parts_sharing_grids(const Scene& scene, const std::vector<io::PartView>& views) {
    const DistinctParts equal = distinct_geometry(scene);
    using SourceMesh = std::tuple<int, int, std::size_t>; // parts of a mesh may have changed since
    const auto source_of = [&](std::size_t i) {
        return SourceMesh{scene.parts[i].document, scene.parts[i].source_mesh, equal.first[i]};
    };
    std::map<SourceMesh, double> most; // the largest stretch of the nodes of a mesh
    for (std::size_t i = 0; i < views.size(); ++i)
        if (double& all = most[source_of(i)]; scene.parts[i].source_mesh >= 0)
            all = std::max(all, stretch_of(views[i].largest));
    return equal.split_by([&](std::size_t i) -> std::int64_t {
        const double stretch =
            scene.parts[i].source_mesh >= 0 ? most[source_of(i)] : stretch_of(views[i].largest);
        // Float32 transforms of the same scale differ by less than a millionth.
        return stretch > 0 && std::isfinite(stretch)
                   ? std::llround(logarithm(stretch) * std::numbers::log2e * 0x1p20)
                   : 0;
    });
}

EvenGrid even_grid(const Scene& scene, const DistinctParts& shapes, const std::vector<int>& usual,
                   const BitLimits& limits, const std::vector<io::PartView>& views) {
    EvenGrid grid{std::vector<io::Lattice>(scene.parts.size()), usual};
    const Box world = scene.bounds();
    const double whole = step_of_scene(limits.whole, limits.usual);
    if (scene.parts.size() < 2 || !(whole > 0) || !std::isfinite(whole)) return grid;
    std::vector<bool> animated(scene.parts.size());
    for (std::size_t i = 0; i < animated.size(); ++i) animated[i] = views[i].animated;
    const std::vector<bool> moves = with_shared_meshes(scene, std::move(animated));
    std::map<std::pair<std::size_t, bool>, std::vector<std::size_t>> users; // the parts of each shape
    for (std::size_t i = 0; i < scene.parts.size(); ++i) users[{shapes.first[i], moves[i]}].push_back(i);
    for (const auto& [key, parts] : users) {
        const bool moved = key.second;
        double step = HUGE_VAL;
        for (const std::size_t i : parts) {
            const Part& part = scene.parts[i];
            const Box box = part.mesh.bounds();
            const double own = box.longest_side(), here = whole / stretch_of(views[i].largest);
            const bool whole_numbers =
                own / here < 0x1p53 && here > 0; // false if the step is zero or not a number
            if (moved || box.empty() || !whole_numbers) step = 0;
            // Reserve one step at either end for the gap between the origin and the bounds.
            const double least = own / std::max(steps_of(limits.most) - 2, 1.0);
            if (step > 0) step = std::min(step, step_apart(part, box, here, least, parts.size() == 1));
        }
        for (const std::size_t i : parts) {
            if (!(step > 0)) continue;
            const Box box = box_on_grid(scene.parts[i], world, step, parts.size() == 1, limits.draco);
            grid.lattices[i] = {box.min, step};
            grid.bits[i] = bits_for(box.longest_side(), step, limits.most);
        }
    }
    return grid;
}

} // namespace facetmill::write_stage

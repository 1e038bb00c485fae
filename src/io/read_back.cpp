#include "io/read_back.hpp"

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "io/flatten.hpp"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io {

namespace {

/// World positions of the vertices that faces use; of all vertices when there are no faces.
std::vector<Vec3> used_points(const Scene& scene) {
    std::vector<Vec3> points;
    const bool all = scene.face_count() == 0;
    for (const auto& part : scene.parts) {
        const Transform to_world = effective(part);
        std::vector<std::uint8_t> used(part.mesh.vertex_count(), all ? 1 : 0);
        for (Index c = 0; c < part.mesh.corner_count(); ++c) used[part.mesh.vertex(c)] = 1;
        for (std::size_t v = 0; v < used.size(); ++v)
            if (used[v]) points.push_back(to_world.point(part.mesh.positions[v]));
    }
    return points;
}

/// Points in cells of a hashed grid, sorted by cell: the nearest point is looked for in a cell and its
/// neighbours.
class Grid {
  public:
    Grid(const std::vector<Vec3>& points, double cell) : points_(points), cell_(cell) {
        entries_.resize(points.size());
        parallel_for(points.size(), [&](std::size_t i) {
            entries_[i] = {key(cell_of(points[i])), static_cast<Index>(i)};
        });
        radix_sort(entries_, [](const Entry& e) { return e.key; });
    }

    /// The distance to the nearest point when it is below half a cell, else infinity.
    double nearest(const Vec3& p) const {
        const Cell centre = cell_of(p);
        double best = HUGE_VAL;
        for (int i = 0; i < 8; ++i) {
            Cell c = centre;
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (i >> axis & 1) {
                    const double within = p[axis] / cell_ - static_cast<double>(centre[axis]);
                    c[axis] += within < 0.5 ? -1 : 1;
                }
            const std::uint64_t k = key(c);
            auto it = std::lower_bound(entries_.begin(), entries_.end(), k,
                                       [](const Entry& e, std::uint64_t x) { return e.key < x; });
            for (; it != entries_.end() && it->key == k; ++it)
                best = std::min(best, length(points_[it->point] - p));
        }
        return best;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;
    struct Entry {
        std::uint64_t key;
        Index point;
    };
    Cell cell_of(const Vec3& p) const {
        Cell c;
        for (std::size_t axis = 0; axis < 3; ++axis)
            c[axis] = static_cast<std::int64_t>(std::floor(p[axis] / cell_));
        return c;
    }
    static std::uint64_t key(const Cell& c) {
        std::uint64_t h = 0;
        for (const std::int64_t x : c) h = hashed(h, static_cast<std::uint64_t>(x));
        return h;
    }

    const std::vector<Vec3>& points_;
    double cell_;
    std::vector<Entry> entries_;
};

double farthest(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double tolerance) {
    // Most formats keep the order: then nothing need be searched.
    const auto max = [](double a, double b) { return std::max(a, b); };
    if (from.size() == to.size()) {
        const double same_order = parallel_reduce(
            from.size(), 0.0,
            [&](std::size_t begin, std::size_t end) {
                double most = 0;
                for (std::size_t i = begin; i < end; ++i) most = std::max(most, length(from[i] - to[i]));
                return most;
            },
            max);
        if (same_order <= tolerance) return same_order;
    }
    const Grid grid(to, std::max(2.5 * tolerance, 1e-300));
    return parallel_reduce(
        from.size(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double most = 0;
            for (std::size_t i = begin; i < end; ++i) most = std::max(most, grid.nearest(from[i]));
            return most;
        },
        max);
}

/// How far the format may move a point: float32's rounding of the largest coordinate (twice, for a node's
/// transform between), and half a step of Draco's grid in every direction.
double allowed(const Scene& scene, const WriteSettings& settings) {
    Box world;
    double largest = 0, step = 0;
    for (const auto& part : scene.parts) {
        Box own;
        const Transform to_world = effective(part);
        for (const Vec3& p : part.mesh.positions) own.add(p), world.add(to_world.point(p));
        if (own.empty()) continue;
        double scale = 0; // the longest column is at most this times a unit of the part
        for (const auto& row : to_world.m)
            for (int c = 0; c < 3; ++c) scale += row[c] * row[c];
        const double reach = std::max(length(own.min), length(own.max)) * std::sqrt(scale);
        largest = std::max(largest, reach);
        if (settings.draco.on && settings.draco.position_bits > 0) {
            const Vec3 e = own.extent();
            const double range = std::max({e.x, e.y, e.z}) * std::sqrt(scale);
            step = std::max(
                step, range / static_cast<double>((std::int64_t{1} << settings.draco.position_bits) - 1));
        }
    }
    if (!world.empty()) largest = std::max({largest, length(world.min), length(world.max)});
    constexpr double float_step = 1.0 / (1 << 23);
    return largest * 2 * float_step +
           step; // half a step times the square root of three, and a margin for rounding
}

} // namespace

Json ReadBack::json() const {
    return {{"vertices", vertices}, {"faces", faces}, {"position_error", position_error}};
}

ReadBack read_back(const Input& file, const Codec& codec, const Scene& scene, const WriteSettings& settings) {
    ReadBack back;
    const auto refuse = [&](std::string message) {
        throw Error(ErrorKind::output, "E-READBACK",
                    fmt::format("'{}' does not hold what was written: {}", file.name(), message),
                    "this is a fault of facetmill or of the disk; older outputs are untouched");
    };
    ReadLog log;
    try {
        back.scene = read_scene(file, {}, log, &codec);
    } catch (const Error& error) {
        refuse(error.diagnostics().front().message);
    }
    std::size_t polygons = 0, triangles = 0;
    for (const auto& part : scene.parts) {
        polygons += part.mesh.face_count();
        triangles += part.mesh.corner_count() - 2 * part.mesh.face_count();
    }
    for (const auto& part : back.scene.parts) back.vertices += part.mesh.vertex_count();
    back.faces = back.scene.face_count();
    if (back.faces != polygons && back.faces != triangles)
        refuse(fmt::format("{} faces, expected {}", back.faces,
                           polygons == triangles ? fmt::format("{}", polygons)
                                                 : fmt::format("{} (or {} triangles)", polygons, triangles)));
    back.tolerance = allowed(scene, settings);
    const std::vector<Vec3> wanted = used_points(scene), found = used_points(back.scene);
    back.position_error =
        std::max(farthest(wanted, found, back.tolerance), farthest(found, wanted, back.tolerance));
    if (back.position_error > back.tolerance)
        refuse(fmt::format("a vertex moved farther than {}", back.tolerance));
    return back;
}

} // namespace facetmill::io

#include "geometry/tile/tile.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <optional>
#include <tbb/parallel_invoke.h>

namespace facetmill {

namespace {

using TileCell = std::array<std::int64_t, 3>;

struct CellRange {
    double low = -HUGE_VAL, high = HUGE_VAL; ///< range of cells
};

class Tiler {
  public:
    Tiler(const TileSettings& settings, bool cloud) : settings_(settings), cloud_(cloud) {
        for (const TileAxis& a : settings.axes)
            if (!(a.size > 0) || !std::isfinite(a.size) || !std::isfinite(a.origin))
                throw Error(ErrorKind::usage, "E-TILE", "a tile's size must be above zero");
    }

    /// within: the remaining range of cells along this axis. A point that rounding moves beyond its cut
    /// plane stays on its side of it, so every cut leaves fewer cells and the recursion ends.
    TileResult split(Mesh mesh, CutMemory memory, std::size_t axis, TileCell cell,
                     std::optional<CellRange> limits = {}) {
        if (size_of(mesh) == 0) return {};
        if (axis == settings_.axes.size()) return finished(std::move(mesh), std::move(memory), cell);
        const CellRange within = limits.value_or(all_cells(settings_.axes[axis]));
        const TileAxis& a = settings_.axes[axis];
        CellRange cells = cells_of(mesh, a);
        cells.low = std::clamp(cells.low, within.low, within.high);
        cells.high = std::clamp(cells.high, within.low, within.high);
        if (cells.low >= cells.high) {
            cell[a.axis] = static_cast<std::int64_t>(cells.low);
            return split(std::move(mesh), std::move(memory), axis + 1, cell);
        }
        const double middle = first_plane(cells);
        ClipSettings settings = settings_.clip;
        settings.planes = {pulled_back(plane_at(a, middle), settings_.to_world)};
        settings.keep = Keep::both;
        settings.memory = std::move(memory);
        ClipResult halves = clip(std::move(mesh), settings);
        // Due to rounding in the world, a mesh that the plane only touches may extend beyond it. It belongs
        // to the neighbouring cell.
        if (size_of(halves.front) == 0 || size_of(halves.back) == 0)
            return one_side(std::move(halves), axis, cell, middle, within);
        TileResult front, back;
        tbb::parallel_invoke(
            [&] {
                back = split(std::move(halves.back), halves.memory, axis, cell,
                             CellRange{within.low, middle - 1});
            },
            [&] {
                front =
                    split(std::move(halves.front), halves.memory, axis, cell, CellRange{middle, within.high});
            });
        return joined(std::move(back), std::move(front), halves);
    }

  private:
    /// The number of elements to cut: faces, or the points of a cloud.
    std::size_t size_of(const Mesh& mesh) const { return cloud_ ? mesh.vertex_count() : mesh.face_count(); }

    static CellRange all_cells(const TileAxis& a) {
        return a.count > 0 ? CellRange{0, static_cast<double>(a.count - 1)} : CellRange{};
    }

    /// The first border to cut: the index divisible by the highest power of two, with 0 first of all. So an
    /// edge on a border is cut in the same order in both neighbours, and its points are rounded identically.
    static double first_plane(const CellRange& cells) {
        double best = cells.low + 1;
        for (double step = 2; best != 0; step *= 2) {
            const double next = std::ceil((cells.low + 1) / step) * step;
            if (next > cells.high) break;
            best = next;
        }
        return best;
    }
    static Plane plane_at(const TileAxis& a, double k) {
        Plane plane{{}, {}, 0};
        plane.normal[a.axis] = 1;
        plane.through[a.axis] = a.origin + k * a.size;
        return plane;
    }

    CellRange cells_of(const Mesh& mesh, const TileAxis& a) const {
        double least = HUGE_VAL, most = -HUGE_VAL;
        const auto add = [&](const Vec3& p) {
            least = std::min(least, p[a.axis]);
            most = std::max(most, p[a.axis]);
        };
        if (settings_.to_world.identity()) {
            add(mesh.bounds().min);
            add(mesh.bounds().max);
        } else
            for (const Vec3& p : mesh.positions) add(settings_.to_world.point(p));
        CellRange r{std::floor((least - a.origin) / a.size), std::ceil((most - a.origin) / a.size) - 1};
        if (!(std::fabs(r.low) < 1e9 && std::fabs(r.high) < 1e9) && r.high - r.low < 1e9)
            throw Error(ErrorKind::limit, "E-TILE",
                        fmt::format("a part lies {:.3g} tiles from the grid's origin along one axis, but at "
                                    "most 1e+09 are possible",
                                    std::max(std::fabs(r.low), std::fabs(r.high))),
                        "choose a nearer origin, or a larger size");
        if (!(r.high - r.low < static_cast<double>(settings_.limit)))
            throw Error(ErrorKind::limit, "E-TILE",
                        fmt::format("a part would be cut into about {:.3g} rows of tiles along one axis",
                                    r.high - r.low + 1),
                        "choose a larger size");
        // Compares with the rounded planes.
        while (a.origin + r.low * a.size > least) --r.low;
        while (a.origin + (r.low + 1) * a.size <= least) ++r.low;
        while (a.origin + (r.high + 1) * a.size < most) ++r.high;
        if (cloud_ && a.origin + (r.high + 1) * a.size <= most)
            ++r.high; // a point on a plane counts as in front of it
        while (!cloud_ && r.high > r.low && a.origin + r.high * a.size >= most) --r.high;
        return r;
    }

    TileResult one_side(ClipResult halves, std::size_t axis, TileCell cell, double middle, CellRange within) {
        const bool front = size_of(halves.back) == 0;
        Mesh& mesh = front ? halves.front : halves.back;
        const TileAxis& a = settings_.axes[axis];
        const CellRange cells = cells_of(mesh, a);
        TileResult whole;
        if (front ? cells.low < middle
                  : cells.high >= middle) { // may occur by rounding, or with isolated vertices
            cell[a.axis] = static_cast<std::int64_t>(front ? middle : middle - 1);
            whole = split(std::move(mesh), halves.memory, axis + 1, cell);
        } else {
            (front ? within.low : within.high) = front ? middle : middle - 1;
            whole = split(std::move(mesh), halves.memory, axis, cell, within);
        }
        return joined(std::move(whole), {}, halves);
    }

    TileResult finished(Mesh mesh, CutMemory memory, const TileCell& cell) {
        if (++made_ > settings_.limit)
            throw Error(ErrorKind::limit, "E-TILE",
                        fmt::format("there would be more than {} tiles", settings_.limit),
                        "choose a larger size");
        for (const TileAxis& a : settings_.axes) {
            const std::string name = std::string("tile_") + "xyz"[a.axis];
            const Domain domain = cloud_ ? Domain::wedge : Domain::face;
            const std::size_t count = cloud_ ? mesh.wedge_count() : mesh.face_count();
            mesh.drop(name, domain);
            mesh.attributes.push_back(
                {name, domain, Role::index, 1, false,
                 std::vector<std::int32_t>(count, static_cast<std::int32_t>(cell[a.axis]))});
        }
        TileResult result;
        result.tiles.push_back({cell, std::move(mesh)});
        result.memory = std::move(memory);
        return result;
    }

    static TileResult joined(TileResult a, TileResult b, const ClipResult& halves) {
        for (Tile& t : b.tiles) a.tiles.push_back(std::move(t));
        a.memory.add_all(b.memory.entries);
        AttributeChanges changes = halves.changes;
        merge_changes(changes, a.changes);
        merge_changes(changes, b.changes);
        a.changes = std::move(changes);
        a.cut_faces += halves.cut_faces + b.cut_faces;
        a.cap_faces += halves.cap_faces + b.cap_faces;
        a.open.insert(a.open.begin(), halves.open.begin(), halves.open.end());
        a.open.insert(a.open.end(), b.open.begin(), b.open.end());
        return a;
    }

    const TileSettings& settings_;
    const bool cloud_; ///< the mesh has no faces, so its points are sorted into the cells
    std::atomic<std::size_t> made_ = 0;
};

} // namespace

TileResult tile(Mesh mesh, const TileSettings& settings) {
    const bool cloud = mesh.face_count() == 0;
    TileResult result = Tiler(settings, cloud).split(std::move(mesh), settings.clip.memory, 0, {});
    std::sort(result.tiles.begin(), result.tiles.end(), [](const Tile& a, const Tile& b) {
        return std::tie(a.cell[2], a.cell[1], a.cell[0]) < std::tie(b.cell[2], b.cell[1], b.cell[0]);
    });
    return result;
}

} // namespace facetmill

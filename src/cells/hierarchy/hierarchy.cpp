#include "cells/hierarchy/hierarchy.hpp"

#include "base/text/readable_numbers.hpp"
#include "cells/hierarchy/hierarchy_nodes.hpp"
#include "cells/partition/kept_partition.hpp"
#include "geometry/edit/moved.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

// Measured: the peak memory of simplify per input triangle, and the process's base memory.
constexpr std::uint64_t bytes_of_face = 300, bytes_of_process = std::uint64_t{28} << 20;
// The peak memory for meshes with more vertices than a connected surface has.
constexpr std::uint64_t bytes_of_face_alone = 200, bytes_of_vertex = 200;
// The peak memory with the whole mesh in memory and the deviation measured.
constexpr std::uint64_t bytes_in_core = 200;

/// A node keeps more faces than its share of the target, so that nodes above can choose. Nodes near the root
/// keep fewer.
constexpr std::uint64_t slack[] = {1, 2, 4};
/// Extra faces per held vertex, because held vertices need faces of their own.
constexpr std::uint64_t faces_of_held = 3;

std::uint64_t target_of(std::uint64_t faces, const SimplifySettings& settings) {
    std::uint64_t target = faces;
    if (settings.ratio)
        target = static_cast<std::uint64_t>(std::ceil(*settings.ratio * static_cast<double>(faces)));
    if (settings.faces) target = std::min<std::uint64_t>(target, *settings.faces);
    return std::max<std::uint64_t>(target, 1);
}

class Hierarchy {
  public:
    Hierarchy(const Partition& partition, const SimplifySettings& settings, const CellResources& means,
              const Transform& transform)
        : partition_(partition), settings_(settings), means_(means), transform_(transform),
          hierarchy_nodes_(hierarchy_nodes_of(partition)), left_(hierarchy_nodes_, means, true),
          target_(target_of(partition.faces(), settings)),
          diagonal_(partition.source().contents().bounds.diagonal()) {}

    HierarchyResult run() {
        settle_all(left_.take_up(std::vector<std::uint8_t>(hierarchy_nodes_.size(), 1), true));
        const std::size_t root = hierarchy_nodes_.size() - 1;
        require_room(root);
        Cell cell = cell_of(root);
        HierarchyResult result;
        const double area = area_of(root, cell);
        SimplifyResult r = simplified(root, cell);
        const StationWork work = work_with(root, area, r);
        result.error = work.error;
        result.area_before = work.area;
        result.collapses = work.collapses;
        result.turned = work.turned;
        result.mesh = std::move(r.mesh);
        result.changes = std::move(r.changes);
        result.stop = r.stop;
        result.blocked = r.blocked;
        result.cells = partition_.tree().leaves.size();
        result.levels = levels_of(hierarchy_nodes_);
        result.faces_before = partition_.faces();
        return result;
    }

    void run(const CellJob& job) {
        settle_all(left_.take_up(hierarchy_nodes_of_job(hierarchy_nodes_, job), false));
        const std::string text = means_.key + "\n";
        means_.kept->write(stamp_of(job), {std::as_bytes(std::span(text))});
    }

  private:
    void settle_all(const std::vector<std::uint8_t>& wanted) {
        settle_below_root(
            hierarchy_nodes_, wanted, means_.memory > bytes_of_process ? means_.memory - bytes_of_process : 0,
            [&](std::size_t s) {
                require_room(s);
                return bytes_given(s);
            },
            [&](std::size_t s) { settle(s); });
    }

    /// A leaf's area comes from its faces; nodes above use the recorded area.
    double area_of(std::size_t station, const Cell& cell) const {
        const Station& s = hierarchy_nodes_[station];
        if (s.is_leaf()) return surface_size(cell.mesh, transform_, false).area;
        double area = 0;
        for (const std::size_t child : s.children) area += left_.work(child).area;
        return area;
    }

    /// The memory needed to simplify the station, in bytes.
    std::uint64_t bytes_given(std::size_t station) const {
        const Station& s = hierarchy_nodes_[station];
        if (s.is_leaf())
            return s.faces * bytes_of_face_alone +
                   s.faces * partition_.vertices() / partition_.faces() * bytes_of_vertex;
        return left_.faces_below(station) * bytes_of_face_alone +
               left_.vertices_below(station) * bytes_of_vertex;
    }

    /// Throws a limit error (E-MEMORY) if cells did not shrink enough to be joined.
    void require_room(std::size_t station) const {
        const std::uint64_t needed = bytes_of_process + bytes_given(station);
        if (hierarchy_nodes_[station].is_leaf() || needed <= means_.memory) return;
        throw out_of_memory(fmt::format("cells of {} triangles were simplified to {} and not further "
                                        "(non-manifold regions, many components and max_quadric_error block "
                                        "edges); joining them needs {}, but --memory allows {}",
                                        grouped(hierarchy_nodes_[station].faces),
                                        grouped(left_.faces_below(station)), sized(needed),
                                        sized(means_.memory)),
                            "give more memory, ask for more faces, or set max_quadric_error: off");
    }

    void settle(std::size_t station) {
        Cell cell = cell_of(station);
        const double area = area_of(station, cell);
        SimplifyResult r = simplified(station, cell);
        const StationWork work = work_with(station, area, r);
        if (hierarchy_nodes_[station].is_leaf()) require_unchanged(partition_.source().contents().files);
        left_.put(station, reduced(std::move(r.mesh), r.sources, cell), work);
    }

    /// The work at the station and below it.
    StationWork work_with(std::size_t station, double area, const SimplifyResult& r) const {
        StationWork work;
        work.area = area;
        for (const std::size_t child : hierarchy_nodes_[station].children) {
            const StationWork& below = left_.work(child);
            work.error = std::max(work.error, below.error);
            work.collapses += below.collapses;
            work.turned += below.turned;
        }
        work.error += r.largest_error.value_or(0);
        work.collapses += r.collapses;
        work.turned += r.turned;
        return work;
    }

    Cell cell_of(std::size_t station) const {
        const Station& s = hierarchy_nodes_[station];
        return s.is_leaf() ? partition_.cell(s.leaf) : left_.joined_at(station, partition_.tree());
    }

    /// Moves the cell's mesh out.
    SimplifyResult simplified(std::size_t station, Cell& cell) const {
        const Station& s = hierarchy_nodes_[station];
        SimplifySettings settings = settings_;
        settings.ratio.reset();
        std::uint64_t held = 0;
        settings.lock.vertices.resize(cell.home.size());
        for (std::size_t v = 0; v < cell.home.size(); ++v)
            held += settings.lock.vertices[v] = cell.home[v] != Cell::inner;
        settings.lock.apart = true;
        const double share = static_cast<double>(target_) *
                             (static_cast<double>(s.faces) / static_cast<double>(partition_.faces()));
        settings.faces = s.level == 0 ? target_
                                      : static_cast<std::size_t>(std::ceil(share)) *
                                                slack[std::min<std::size_t>(s.level, 2)] +
                                            faces_of_held * held;
        // Attribute weights scale with the diagonal of the mesh; they must use the whole mesh's diagonal.
        const double own = cell.mesh.bounds().diagonal(), whole = own > 0 ? diagonal_ / own : 1;
        for (double* weight : {&settings.weights.normal, &settings.weights.colour, &settings.weights.skin})
            *weight *= whole;
        return simplify(std::move(cell.mesh), settings);
    }

    const Partition& partition_;
    const SimplifySettings& settings_;
    const CellResources& means_;
    const Transform& transform_;
    std::vector<Station> hierarchy_nodes_; ///< the root is last
    LeftCells left_;
    std::uint64_t target_;
    double diagonal_;
};

} // namespace

std::optional<std::string> why_not_in_cells(const SimplifySettings& s) {
    using Method = SimplifySettings::Method;
    if (s.method != Method::quadric && s.method != Method::quadric_endpoints)
        return "methods other than quadric and quadric-endpoints need the whole mesh";
    if (s.topology != SimplifySettings::Topology::keep) return "topology: allow needs the whole mesh";
    if (s.self_intersections != SimplifySettings::Intersections::ignore)
        return "self_intersections needs the whole mesh";
    if (s.max_error) return "max_error is measured on the whole mesh";
    if (s.vertices) return "the target must be faces or a ratio";
    if (!s.levels.empty()) return "lods needs the whole mesh";
    return {};
}

std::uint64_t memory_for_cells(std::uint64_t faces, std::uint64_t target) {
    const std::uint64_t root = std::min(faces, slack[1] * target);
    return bytes_of_process + bytes_of_face * std::max(root, std::min(faces, faces_of_cell));
}

std::uint64_t memory_in_core(std::uint64_t faces) { return bytes_of_process + bytes_in_core * faces; }

namespace {

void require_memory(const Partition& partition, const SimplifySettings& settings,
                    const CellResources& means) {
    const std::uint64_t target = target_of(partition.faces(), settings);
    const std::uint64_t needed = memory_for_cells(partition.faces(), target);
    if (needed <= means.memory) return;
    throw out_of_memory(
        fmt::format("a result of {} triangles needs at least {} in cells, but --memory allows {}", target,
                    sized(needed), sized(means.memory)),
        "ask for fewer faces, or give more memory");
}

} // namespace

HierarchyResult simplify_cells(const Partition& partition, const SimplifySettings& settings,
                               const CellResources& means, const Transform& transform) {
    require_memory(partition, settings, means);
    return Hierarchy(partition, settings, means, transform).run();
}

void simplify_job(const Partition& partition, const SimplifySettings& settings, const CellResources& means,
                  const Transform& transform) {
    require_memory(partition, settings, means);
    try {
        Hierarchy(partition, settings, means, transform).run(*means.job);
    } catch (const UnreadableScratch& error) {
        make_cells_due(*means.kept, error.diagnostics().front().message);
    }
}

} // namespace facetmill::cells

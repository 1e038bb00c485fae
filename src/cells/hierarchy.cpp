#include "cells/hierarchy.hpp"

#include "base/memory.hpp"
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/readable_numbers.hpp"
#include "cache/fields.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

// Measured: the memory that simplify takes at its peak for each triangle that it is given, and what the
// process has beside.
constexpr std::uint64_t bytes_of_face = 300, bytes_of_process = std::uint64_t{28} << 20;
// The same where there are more vertices than a surface that hangs together has.
constexpr std::uint64_t bytes_of_face_alone = 200, bytes_of_vertex = 200;
// ... and where all is in memory, with the deviation measured.
constexpr std::uint64_t bytes_in_core = 200;

/// Faces that are kept at a node over its part of the target, so that those above may choose: the nodes
/// nearest to the root keep less.
constexpr std::uint64_t slack[] = {1, 2, 4};
/// ... and for each vertex that is held, since those need faces of their own.
constexpr std::uint64_t faces_of_held = 3;

/// What is simplified as one: a leaf of the tree, or what is left of up to four nodes below.
struct Station {
    std::uint32_t node = 0, leaf = Tree::no_node;
    std::vector<std::size_t> children;
    std::size_t level = 0;   ///< 0: the root
    std::uint64_t faces = 0; ///< of the mesh as it came
};

/// What a station leaves behind, on disk.
struct Left {
    Block block;
    double error = 0;
    std::size_t collapses = 0, turned = 0, vertices = 0, faces = 0;
};

/// Every other level of the tree, and its leaves; each after its children.
class Stations {
  public:
    explicit Stations(const Partition& partition) : partition_(partition) { add(0, 0); }
    std::vector<Station> all;

  private:
    std::size_t add(std::uint32_t node, std::size_t level) {
        Station station;
        station.node = node;
        station.level = level;
        collect(node, true, station);
        all.push_back(std::move(station));
        return all.size() - 1;
    }

    void collect(std::uint32_t node, bool first, Station& station) {
        const Tree::Node& n = partition_.tree().nodes[node];
        if (n.is_leaf() && first) {
            station.leaf = n.leaf;
            station.faces = partition_.faces_of(n.leaf);
            return;
        }
        for (const std::uint32_t child : n.child) {
            if (first && !partition_.tree().nodes[child].is_leaf()) {
                collect(child, false, station);
                continue;
            }
            station.children.push_back(add(child, station.level + 1));
            station.faces += all[station.children.back()].faces;
        }
    }

    const Partition& partition_;
};

std::uint64_t target_of(std::uint64_t faces, const SimplifySettings& settings) {
    std::uint64_t target = faces;
    if (settings.ratio)
        target = static_cast<std::uint64_t>(std::ceil(*settings.ratio * static_cast<double>(faces)));
    if (settings.faces) target = std::min<std::uint64_t>(target, *settings.faces);
    return std::max<std::uint64_t>(target, 1);
}

class Hierarchy {
  public:
    Hierarchy(const Partition& partition, const SimplifySettings& settings, const Means& means)
        : partition_(partition), settings_(settings), means_(means), stations_(Stations(partition).all),
          left_(stations_.size()), file_(means.scratch), target_(target_of(partition.faces(), settings)),
          diagonal_(partition.source().contents().bounds.diagonal()) {}

    HierarchyResult run() {
        std::size_t deepest = 0;
        for (const Station& s : stations_) deepest = std::max(deepest, s.level);
        std::vector<std::size_t> leaves;
        for (std::size_t s = 0; s + 1 < stations_.size(); ++s)
            if (stations_[s].leaf != Tree::no_node) leaves.push_back(s);
        work(leaves);
        for (std::size_t level = deepest; level > 0; --level) {
            std::vector<std::size_t> joins;
            for (std::size_t s = 0; s + 1 < stations_.size(); ++s)
                if (stations_[s].level == level && stations_[s].leaf == Tree::no_node) joins.push_back(s);
            work(joins);
        }
        const std::size_t root = stations_.size() - 1;
        require_room(root);
        Cell cell = cell_of(root);
        HierarchyResult result;
        result.error = error_below(root);
        SimplifyResult r = simplified(root, cell);
        result.error += r.largest_error.value_or(0);
        result.mesh = std::move(r.mesh);
        result.changes = std::move(r.changes);
        result.stop = r.stop;
        result.blocked = r.blocked;
        result.collapses = r.collapses;
        result.turned = r.turned;
        for (const Left& left : left_) {
            result.collapses += left.collapses;
            result.turned += left.turned;
        }
        result.cells = partition_.tree().leaves.size();
        result.levels = deepest + 1;
        result.faces_before = partition_.faces();
        return result;
    }

  private:
    /// The stations, as many at a time as memory and threads allow.
    void work(const std::vector<std::size_t>& stations) {
        if (stations.empty()) return;
        std::uint64_t largest = 0;
        for (const std::size_t s : stations) {
            require_room(s);
            largest = std::max(largest, bytes_given(s));
        }
        const std::uint64_t free = means_.memory > bytes_of_process ? means_.memory - bytes_of_process : 0;
        const std::size_t workers = static_cast<std::size_t>(std::clamp<std::uint64_t>(
            free / std::max<std::uint64_t>(1, largest), 1,
            std::min<std::uint64_t>(static_cast<std::uint64_t>(threads()), stations.size())));
        std::atomic<std::size_t> next{0};
        parallel_for(
            workers,
            [&](std::size_t) {
                for (std::size_t i = next++; i < stations.size(); i = next++) settle(stations[i]);
            },
            1);
    }

    /// Bytes that simplifying the station takes.
    std::uint64_t bytes_given(std::size_t station) const {
        const Station& s = stations_[station];
        if (s.leaf != Tree::no_node)
            return s.faces * bytes_of_face_alone +
                   s.faces * partition_.vertices() / partition_.faces() * bytes_of_vertex;
        std::uint64_t bytes = 0;
        for (const std::size_t child : s.children)
            bytes += left_[child].faces * bytes_of_face_alone + left_[child].vertices * bytes_of_vertex;
        return bytes;
    }

    /// Throws limit (E-MEMORY) where cells did not get small enough to be joined.
    void require_room(std::size_t station) const {
        const std::uint64_t needed = bytes_of_process + bytes_given(station);
        if (stations_[station].leaf != Tree::no_node || needed <= means_.memory) return;
        std::uint64_t faces = 0;
        for (const std::size_t child : stations_[station].children) faces += left_[child].faces;
        throw out_of_memory(
            fmt::format(
                "cells of {} triangles were simplified to {} and not further (non-manifold places, many "
                "components and max_quadric_error hold edges); joining them needs {}, --memory gives {}",
                grouped(stations_[station].faces), grouped(faces), sized(needed), sized(means_.memory)),
            "give more memory, ask for more faces, or set max_quadric_error: off");
    }

    void settle(std::size_t station) {
        Cell cell = cell_of(station);
        Left& left = left_[station];
        left.error = error_below(station);
        SimplifyResult r = simplified(station, cell);
        left.error += r.largest_error.value_or(0);
        left.collapses = r.collapses;
        left.turned = r.turned;
        left.vertices = r.mesh.vertex_count();
        left.faces = r.mesh.face_count();
        Cell done;
        for (const Index source : r.sources) {
            const bool held = cell.home[source] != Cell::inner;
            done.names.push_back(held ? cell.names[source] : 0);
            done.home.push_back(cell.home[source]);
        }
        cell = {};
        done.mesh = std::move(r.mesh);
        cache::ByteWriter writer;
        writer(done.mesh, done.names, done.home);
        done = {};
        left.block = file_.put(writer.bytes);
    }

    double error_below(std::size_t station) const {
        double error = 0;
        for (const std::size_t child : stations_[station].children)
            error = std::max(error, left_[child].error);
        return error;
    }

    Cell cell_of(std::size_t station) const {
        const Station& s = stations_[station];
        const std::uint8_t depth = partition_.tree().nodes[s.node].depth;
        std::vector<Cell> cells;
        if (s.leaf != Tree::no_node) cells.push_back(partition_.cell(s.leaf));
        for (const std::size_t child : s.children) {
            const io::Bytes bytes = file_.get(left_[child].block);
            cache::ByteReader reader(bytes);
            Cell& cell = cells.emplace_back();
            reader(cell.mesh, cell.names, cell.home);
        }
        return joined(std::move(cells), depth);
    }

    /// The cell's mesh is taken.
    SimplifyResult simplified(std::size_t station, Cell& cell) const {
        const Station& s = stations_[station];
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
        // Attributes weigh by the diagonal of the mesh, which is that of the whole.
        const double own = cell.mesh.bounds().diagonal(), whole = own > 0 ? diagonal_ / own : 1;
        for (double* weight : {&settings.weights.normal, &settings.weights.colour, &settings.weights.skin})
            *weight *= whole;
        return simplify(std::move(cell.mesh), settings);
    }

    const Partition& partition_;
    const SimplifySettings& settings_;
    const Means& means_;
    std::vector<Station> stations_; ///< the root is the last
    std::vector<Left> left_;        ///< [stations]
    BlockFile file_;
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

HierarchyResult simplify_cells(const Partition& partition, const SimplifySettings& settings,
                               const Means& means) {
    const std::uint64_t target = target_of(partition.faces(), settings);
    const std::uint64_t needed = memory_for_cells(partition.faces(), target);
    if (needed > means.memory)
        throw out_of_memory(
            fmt::format("a result of {} triangles needs at least {} in cells, --memory gives {}", target,
                        sized(needed), sized(means.memory)),
            "ask for fewer faces, or give more memory");
    return Hierarchy(partition, settings, means).run();
}

} // namespace facetmill::cells

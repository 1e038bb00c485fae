#include "cells/hierarchy/hierarchy_nodes.hpp"

#include "base/text/words.hpp"
#include "cache/fields.hpp"
#include "cells/storage/packed_numbers.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

/// Faces and leaves below each node of the tree.
struct BelowNodes {
    std::vector<std::uint64_t> faces;      ///< [nodes] numbers of faces
    std::vector<std::uint32_t> first_leaf; ///< [nodes] first leaf
    std::vector<std::uint32_t> end_leaf;   ///< [nodes] one past the last leaf

    explicit BelowNodes(const Partition& partition) {
        const std::vector<Tree::Node>& nodes = partition.tree().nodes;
        faces.resize(nodes.size());
        first_leaf.resize(nodes.size());
        end_leaf.resize(nodes.size());
        for (std::size_t n = nodes.size(); n-- > 0;) { // children come after their node
            const Tree::Node& node = nodes[n];
            const auto [low, high] = node.child;
            faces[n] = node.is_leaf() ? partition.faces_of(node.leaf) : faces[low] + faces[high];
            first_leaf[n] = node.is_leaf() ? node.leaf : first_leaf[low];
            end_leaf[n] = node.is_leaf() ? node.leaf + 1 : end_leaf[high];
        }
    }
};

class StationMaker {
  public:
    /// together: see hierarchy_nodes_of. 0: a station per leaf.
    StationMaker(const Partition& partition, std::uint64_t together)
        : tree_(partition.tree()), below_(partition), together_(together) {
        add(0, 0, together > 0 && height_of(0) % 2 == 1);
    }
    std::vector<Station> all;

  private:
    bool is_end(std::uint32_t node) const {
        return tree_.nodes[node].is_leaf() || below_.faces[node] <= together_;
    }

    std::size_t height_of(std::uint32_t node) const {
        if (is_end(node)) return 0;
        const auto [low, high] = tree_.nodes[node].child;
        return 1 + std::max(height_of(low), height_of(high));
    }

    std::size_t add(std::uint32_t node, std::size_t level, bool two = false) {
        Station station;
        station.node = node;
        station.level = level;
        station.faces = below_.faces[node];
        if (is_end(node)) {
            station.leaf = below_.first_leaf[node];
            station.end_leaf = below_.end_leaf[node];
        } else
            collect(node, two ? 1 : 2, station);
        all.push_back(std::move(station));
        return all.size() - 1;
    }

    void collect(std::uint32_t node, int levels, Station& station) {
        for (const std::uint32_t child : tree_.nodes[node].child)
            if (levels > 1 && !is_end(child))
                collect(child, levels - 1, station);
            else
                station.children.push_back(add(child, station.level + 1));
    }

    const Tree& tree_;
    BelowNodes below_;
    std::uint64_t together_;
};

/// Writes or reads the record before a cell. left: an entry of LeftCells.
void archive_left(auto& archive, auto& left) {
    archive(left.vertices, left.faces, left.work.error, left.work.area, left.work.collapses,
            left.work.turned);
}

/// The vertices with a home. Most vertices are inner, and their names are not needed.
struct HomesOfSome {
    std::vector<Index> vertices;
    std::vector<std::uint64_t> names;
    std::vector<std::uint8_t> homes;
};

/// Writes a cell in packed form. Moves the mesh's corners out.
void write_cell(cache::ByteWriter& writer, Cell cell) {
    HomesOfSome some;
    for (Index v = 0; v < cell.home.size(); ++v) {
        if (cell.home[v] == Cell::inner) continue;
        some.vertices.push_back(v);
        some.names.push_back(cell.names[v]);
        some.homes.push_back(cell.home[v]);
    }
    const io::Bytes corners = packed_numbers(std::as_bytes(std::span(cell.mesh.corners)));
    cell.mesh.corners = {};
    writer(cell.mesh, corners, some.vertices, some.names, some.homes);
}

Cell read_cell(cache::ByteReader& reader) {
    Cell cell;
    io::Bytes corners;
    HomesOfSome some;
    reader(cell.mesh, corners, some.vertices, some.names, some.homes);
    io::Bytes numbers;
    const std::size_t vertices = cell.mesh.vertex_count(), shared = some.vertices.size();
    if (!unpack_numbers(corners, numbers) || numbers.size() % sizeof(Index) != 0 ||
        some.names.size() != shared || some.homes.size() != shared ||
        std::any_of(some.vertices.begin(), some.vertices.end(), [&](auto v) { return v >= vertices; }))
        throw cache::Corrupt();
    cell.mesh.corners.resize(numbers.size() / sizeof(Index));
    if (!numbers.empty()) std::memcpy(cell.mesh.corners.data(), numbers.data(), numbers.size());
    if (std::any_of(cell.mesh.corners.begin(), cell.mesh.corners.end(),
                    [&](Index v) { return v >= vertices; }))
        throw cache::Corrupt();
    cell.names.assign(cell.mesh.vertex_count(), 0);
    cell.home.assign(cell.mesh.vertex_count(), Cell::inner);
    for (std::size_t i = 0; i < some.vertices.size(); ++i) {
        cell.names[some.vertices[i]] = some.names[i];
        cell.home[some.vertices[i]] = some.homes[i];
    }
    return cell;
}

constexpr std::string_view kept_begin = "facetmill-simplified.";

/// The start of the file names of results with this key.
std::string kept_name_begin(const std::string& key) {
    constexpr std::size_t digits = 16;
    return fmt::format("{}{}.", kept_begin, key.substr(0, digits));
}

std::string kept_name(const std::string& key, std::size_t station) {
    return fmt::format("{}{}", kept_name_begin(key), station);
}

} // namespace

std::vector<Station> hierarchy_nodes_of(const Partition& partition) { return StationMaker(partition, 0).all; }

std::vector<Station> hierarchy_nodes_of(const Partition& partition, std::uint64_t together) {
    return StationMaker(partition, together).all;
}

std::size_t levels_of(const std::vector<Station>& hierarchy_nodes) {
    std::size_t deepest = 0;
    for (const Station& s : hierarchy_nodes) deepest = std::max(deepest, s.level);
    return deepest + 1;
}

namespace {

/// The stations at which the tree is divided into jobs: the stations of a level, and cells above this level.
std::vector<std::size_t> tops_of(const std::vector<Station>& hierarchy_nodes, std::size_t level) {
    std::vector<std::size_t> tops;
    for (std::size_t s = 0; s + 1 < hierarchy_nodes.size(); ++s)
        if (hierarchy_nodes[s].level == level ||
            (hierarchy_nodes[s].is_leaf() && hierarchy_nodes[s].level < level))
            tops.push_back(s);
    return tops;
}

} // namespace

std::string name_of(const CellJob& job) { return fmt::format("job.{}-of-{}", job.number, job.of); }

std::string stamp_of(const CellJob& job) { return "facetmill-" + name_of(job); }

std::vector<std::uint8_t> hierarchy_nodes_of_job(const std::vector<Station>& hierarchy_nodes,
                                                 const CellJob& job) {
    constexpr std::size_t tops_per_job = 2; // several per job balance the work
    std::size_t level = 1;
    while (level + 1 < levels_of(hierarchy_nodes) &&
           tops_of(hierarchy_nodes, level).size() < tops_per_job * job.of)
        ++level;
    std::vector<std::uint8_t> of_job(hierarchy_nodes.size(), 0);
    std::uint64_t before = 0;
    for (const std::size_t top : tops_of(hierarchy_nodes, level)) {
        const std::uint64_t middle = before + hierarchy_nodes[top].faces / 2;
        of_job[top] =
            middle * job.of / std::max<std::uint64_t>(1, hierarchy_nodes.back().faces) + 1 == job.number;
        before += hierarchy_nodes[top].faces;
    }
    for (std::size_t s = hierarchy_nodes.size(); s-- > 0;)
        if (of_job[s])
            for (const std::size_t child : hierarchy_nodes[s].children) of_job[child] = 1;
    return of_job;
}

void settle_below_root(const std::vector<Station>& hierarchy_nodes, const std::vector<std::uint8_t>& wanted,
                       std::uint64_t memory, const std::function<std::uint64_t(std::size_t)>& bytes_of,
                       const std::function<void(std::size_t)>& settle) {
    const auto all_of = [&](const std::vector<std::size_t>& some) {
        if (some.empty()) return;
        std::uint64_t largest = 1;
        for (const std::size_t s : some) largest = std::max(largest, bytes_of(s));
        const auto most = std::min<std::uint64_t>(static_cast<std::uint64_t>(threads()), some.size());
        const auto workers = static_cast<std::size_t>(std::clamp<std::uint64_t>(memory / largest, 1, most));
        std::atomic<std::size_t> next{0};
        parallel_for(
            workers,
            [&](std::size_t) {
                try {
                    for (std::size_t i = next++; i < some.size(); i = next++) settle(some[i]);
                } catch (...) {
                    next = some.size(); // stops the other threads
                    throw;
                }
            },
            1);
    };
    const auto below_root = [&](const auto& of_level) {
        std::vector<std::size_t> some;
        for (std::size_t s = 0; s + 1 < hierarchy_nodes.size(); ++s)
            if (wanted[s] && of_level(hierarchy_nodes[s])) some.push_back(s);
        return some;
    };
    all_of(below_root([](const Station& s) { return s.is_leaf(); }));
    for (std::size_t level = levels_of(hierarchy_nodes); level-- > 1;)
        all_of(below_root([&](const Station& s) { return s.level == level && !s.is_leaf(); }));
}

LeftCells::LeftCells(const std::vector<Station>& hierarchy_nodes, const CellResources& means, bool kept)
    : hierarchy_nodes_(hierarchy_nodes), kept_(kept ? means.kept : nullptr), key_(means.key),
      file_(means.scratch), left_(hierarchy_nodes.size()) {}

void LeftCells::put(std::size_t station, Cell cell, const StationWork& work) {
    Left& left = left_[station];
    left.vertices = cell.mesh.vertex_count();
    left.faces = cell.mesh.face_count();
    left.work = work;
    cache::ByteWriter writer;
    archive_left(writer, left);
    write_cell(writer, std::move(cell));
    if (kept_)
        kept_->put(kept_name(key_, station), key_, writer.bytes);
    else
        left.block = file_.put(writer.bytes);
}

io::Bytes LeftCells::bytes_of(std::size_t station) const {
    if (!kept_) return file_.get(left_[station].block);
    CellFolder::Found found{};
    std::optional<io::Bytes> bytes = kept_->get(kept_name(key_, station), key_, found);
    if (!bytes) unreadable_scratch(kept_->path());
    return std::move(*bytes);
}

CellFolder::Found LeftCells::take(std::size_t station) {
    CellFolder::Found found{};
    const std::optional<io::Bytes> bytes = kept_->get(kept_name(key_, station), key_, found);
    if (!bytes) return found;
    cache::ByteReader reader(*bytes);
    archive_left(reader, left_[station]);
    return found;
}

std::vector<std::uint8_t> LeftCells::take_up(const std::vector<std::uint8_t>& among, bool others_go) {
    std::vector<std::uint8_t> wanted = among;
    if (!kept_) return wanted;
    std::size_t reused = 0, damaged = 0, others = 0, all = 0;
    for (const std::string& name : kept_->names(std::string(kept_begin))) {
        if (!others_go || name.starts_with(kept_name_begin(key_))) continue;
        kept_->remove(name);
        ++others;
    }
    for (std::size_t s = hierarchy_nodes_.size() - 1; s-- > 0;) { // parents before children
        if (!among[s]) continue;
        ++all;
        if (wanted[s]) {
            const CellFolder::Found found = take(s);
            damaged += found == CellFolder::Found::damaged;
            if (found != CellFolder::Found::as_written) continue;
        }
        wanted[s] = 0;
        ++reused;
        for (const std::size_t child : hierarchy_nodes_[s].children) wanted[child] = 0;
    }
    const std::string where = kept_->path().generic_string();
    if (others > 0)
        kept_->tell(fmt::format("{} from other inputs or options removed from '{}'",
                                counted(others, "simplified cell"), where));
    if (damaged > 0)
        kept_->tell(fmt::format("{} in '{}' {} damaged and made again", counted(damaged, "simplified cell"),
                                where, damaged == 1 ? "is" : "are"));
    if (reused > 0)
        kept_->tell(fmt::format("{} of {} simplified cells reused from '{}'", reused, all, where));
    return wanted;
}

Cell LeftCells::joined_at(std::size_t station, const Tree& tree) const {
    const Station& s = hierarchy_nodes_[station];
    std::vector<Cell> cells;
    for (const std::size_t child : s.children) {
        const io::Bytes bytes = bytes_of(child);
        cache::ByteReader reader(bytes);
        Left ignored;
        archive_left(reader, ignored);
        cells.push_back(read_cell(reader));
    }
    return joined(std::move(cells), tree.nodes[s.node].depth);
}

std::uint64_t LeftCells::vertices_below(std::size_t station) const {
    std::uint64_t sum = 0;
    for (const std::size_t child : hierarchy_nodes_[station].children) sum += left_[child].vertices;
    return sum;
}

std::uint64_t LeftCells::faces_below(std::size_t station) const {
    std::uint64_t sum = 0;
    for (const std::size_t child : hierarchy_nodes_[station].children) sum += left_[child].faces;
    return sum;
}

} // namespace facetmill::cells

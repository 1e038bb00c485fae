#include "cells/stations.hpp"

#include "base/parallel.hpp"
#include "cache/fields.hpp"

#include <algorithm>
#include <atomic>

namespace facetmill::cells {

namespace {

class StationMaker {
  public:
    explicit StationMaker(const Partition& partition) : partition_(partition) { add(0, 0); }
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

} // namespace

std::vector<Station> stations_of(const Partition& partition) { return StationMaker(partition).all; }

std::size_t levels_of(const std::vector<Station>& stations) {
    std::size_t deepest = 0;
    for (const Station& s : stations) deepest = std::max(deepest, s.level);
    return deepest + 1;
}

void settle_below_root(const std::vector<Station>& stations, std::uint64_t memory,
                       const std::function<std::uint64_t(std::size_t)>& bytes_of,
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
                for (std::size_t i = next++; i < some.size(); i = next++) settle(some[i]);
            },
            1);
    };
    const auto below_root = [&](const auto& wanted) {
        std::vector<std::size_t> some;
        for (std::size_t s = 0; s + 1 < stations.size(); ++s)
            if (wanted(stations[s])) some.push_back(s);
        return some;
    };
    all_of(below_root([](const Station& s) { return s.is_leaf(); }));
    for (std::size_t level = levels_of(stations); level-- > 1;)
        all_of(below_root([&](const Station& s) { return s.level == level && !s.is_leaf(); }));
}

void LeftCells::put(std::size_t station, const Cell& cell) {
    cache::ByteWriter writer;
    writer(cell.mesh, cell.names, cell.home);
    Left& left = left_[station];
    left.vertices = cell.mesh.vertex_count();
    left.faces = cell.mesh.face_count();
    left.block = file_.put(writer.bytes);
}

Cell LeftCells::joined_at(std::size_t station, const Tree& tree) const {
    const Station& s = stations_[station];
    std::vector<Cell> cells;
    for (const std::size_t child : s.children) {
        const io::Bytes bytes = file_.get(left_[child].block);
        cache::ByteReader reader(bytes);
        Cell& cell = cells.emplace_back();
        reader(cell.mesh, cell.names, cell.home);
    }
    return joined(std::move(cells), tree.nodes[s.node].depth);
}

std::uint64_t LeftCells::vertices_below(std::size_t station) const {
    std::uint64_t sum = 0;
    for (const std::size_t child : stations_[station].children) sum += left_[child].vertices;
    return sum;
}

std::uint64_t LeftCells::faces_below(std::size_t station) const {
    std::uint64_t sum = 0;
    for (const std::size_t child : stations_[station].children) sum += left_[child].faces;
    return sum;
}

} // namespace facetmill::cells

#include "cells/partition/cell_border_walk.hpp"

#include "base/progress.hpp"
#include "base/text/readable_numbers.hpp"
#include "cells/partition/gather.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

constexpr const char* looked_at = "looked_at"; ///< [vertices] 1 if already visited

class RimWalk {
  public:
    RimWalk(const Partition& partition, const CellResources& means, RimVisitor& visitor)
        : partition_(partition), means_(means), visitor_(visitor) {}

    /// The faces of the node with a vertex that cells outside the node share.
    Cell rim_of(std::uint32_t number) {
        const Tree::Node& node = partition_.tree().nodes[number];
        Cell cell;
        if (node.is_leaf()) {
            cell = partition_.cell(node.leaf);
            ProgressScope::report_item(node.leaf, partition_.tree().leaves.size());
            cell.mesh.attributes.clear();
            visitor_.read(cell);
            cell.mesh.attributes.push_back({looked_at, Domain::vertex, Role::index, 1, false,
                                            std::vector<std::uint8_t>(cell.mesh.vertex_count(), 0)});
        } else {
            std::vector<Cell> cells;
            for (const std::uint32_t child : node.child) cells.push_back(rim_of(child));
            require_room(cells);
            cell = joined(std::move(cells), node.depth);
            visitor_.meet(cell.mesh);
        }
        look(cell);
        keep_open(cell);
        return cell;
    }

  private:
    void require_room(const std::vector<Cell>& cells) const {
        const std::uint64_t per_face = visitor_.bytes_per_face();
        std::uint64_t faces = 0;
        for (const Cell& cell : cells) faces += cell.mesh.face_count();
        if (faces * per_face > means_.memory / 2)
            throw out_of_memory(
                fmt::format(
                    "{} triangles at vertices that cells share need {} at once, but --memory allows {}",
                    grouped(faces), sized(2 * faces * per_face), sized(means_.memory)),
                "give more memory");
    }

    void look(Cell& cell) {
        auto& before = std::get<std::vector<std::uint8_t>>(cell.mesh.find(looked_at, Domain::vertex)->data);
        std::vector<Turn> turns(cell.home.size());
        for (std::size_t v = 0; v < turns.size(); ++v)
            turns[v] = cell.home[v] != Cell::inner ? Turn::later : before[v] ? Turn::before : Turn::now;
        visitor_.look(cell.mesh, turns);
        for (std::size_t v = 0; v < turns.size(); ++v) before[v] = turns[v] != Turn::later;
    }

    static void keep_open(Cell& cell) {
        std::vector<Index> faces;
        for (Index f = 0; f < cell.mesh.face_count(); ++f) {
            const auto wedges = cell.mesh.face_wedges(f);
            if (std::any_of(wedges.begin(), wedges.end(),
                            [&](Index v) { return cell.home[v] != Cell::inner; }))
                faces.push_back(f);
        }
        cell = with_faces(std::move(cell), faces);
    }

    const Partition& partition_;
    const CellResources& means_;
    RimVisitor& visitor_;
};

} // namespace

void walk_cell_borders(const Partition& partition, const CellResources& means, RimVisitor& visitor) {
    RimWalk(partition, means, visitor).rim_of(0);
}

} // namespace facetmill::cells

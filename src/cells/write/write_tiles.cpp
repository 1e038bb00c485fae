#include "cells/write/write_tiles.hpp"

#include "base/math/random.hpp"
#include "base/progress.hpp"
#include "base/sort_unique.hpp"
#include "base/text/readable_numbers.hpp"
#include "cells/hierarchy/hierarchy_nodes.hpp"
#include "geometry/pyramid/pyramid.hpp"
#include "io/tileset/tiles.hpp"
#include "mesh/transform.hpp"
#include "parallel/memory.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <map>
#include <mutex>

namespace facetmill::cells {

namespace {

using io::tileset::TreeTile;

constexpr std::uint64_t children_of_tile = 4; // maximum number of children

// Measured: the peak memory of simplifying, measuring and encoding per joined triangle and vertex, and the
// process's base memory.
constexpr std::uint64_t bytes_of_tile_face = 180, bytes_of_tile_vertex = 340,
                        bytes_beside_tiles = std::uint64_t{30} << 20;

/// A number per vertex. Equal positions have equal numbers; other positions rarely do.
std::vector<std::uint64_t> keys_of_places(const Mesh& mesh) {
    std::vector<std::uint64_t> keys;
    keys.reserve(mesh.vertex_count());
    for (const Vec3& p : mesh.positions) {
        std::uint64_t key = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            key = hashed(key, std::bit_cast<std::uint64_t>(p[axis] + 0.0)); // -0 equals 0
        keys.push_back(key);
    }
    return keys;
}

std::vector<std::uint8_t> held_of(const Cell& cell) {
    std::vector<std::uint8_t> held;
    held.reserve(cell.home.size());
    for (const std::uint8_t home : cell.home) held.push_back(home != Cell::inner);
    return held;
}

class TileMaker {
  public:
    TileMaker(const Partition& partition, const Transform& transform, const io::WriteSettings& settings,
              const CellResources& means, const std::function<void(const io::OutputFile&)>& put)
        : partition_(partition), transform_(transform), settings_(io::tileset::settings_of_tiles(settings)),
          means_(means), put_(put),
          hierarchy_nodes_(hierarchy_nodes_of(partition, children_of_tile * settings.tiles.most_faces())),
          left_(hierarchy_nodes_, means, false), names_(hierarchy_nodes_.size()),
          tiles_(hierarchy_nodes_.size()) {
        for (std::size_t s = hierarchy_nodes_.size(); s-- > 0;)
            for (std::size_t c = 0; c < hierarchy_nodes_[s].children.size(); ++c)
                names_[hierarchy_nodes_[s].children[c]] = names_[s] + static_cast<char>('0' + c);
    }

    WrittenTiles run() {
        ProgressSteps steps({1, 1, 10});
        choose_frame();
        steps.next();
        find_shared();
        steps.next();
        settle_below_root(
            hierarchy_nodes_, std::vector<std::uint8_t>(hierarchy_nodes_.size(), 1),
            means_.memory > bytes_beside_tiles ? means_.memory - bytes_beside_tiles : 0,
            [&](std::size_t s) {
                require_room(s);
                return bytes_given(s);
            },
            [&](std::size_t s) { settle(s); });
        const std::size_t root = hierarchy_nodes_.size() - 1;
        require_room(root);
        settle(root);
        return finish();
    }

  private:
    /// Like tileset_frame for all vertices, except that vertices of different cells may coincide.
    void choose_frame() {
        frame_ =
            io::usual_frame(box_of_corners(partition_.source().contents().bounds, transform_), settings_);
        if (auto warning = io::warning_of_place(frame_)) warnings_.emplace(warning->message, *warning);
        const std::size_t n = partition_.tree().leaves.size();
        for (bool changed = true; changed && frame_.step > frame_.finest;) {
            changed = false;
            for (std::uint32_t leaf = 0; leaf < n; ++leaf, ProgressScope::report_item(leaf, n)) {
                Mesh mesh = partition_.cell(leaf).mesh;
                apply(mesh, transform_);
                const double step = io::distinct_step(mesh.positions, frame_);
                changed |= step < frame_.step;
                frame_.step = step;
            }
        }
    }

    Cell in_frame(std::uint32_t leaf) const {
        Cell cell = partition_.cell(leaf);
        apply(cell.mesh, transform_);
        io::put_into_frame(cell.mesh.positions, frame_);
        return cell;
    }

    void find_shared() {
        borders_.emplace(partition_.tree(), means_.scratch, means_.memory, partition_.faces(),
                         [&](std::uint32_t leaf) {
                             auto keys = keys_of_places(in_frame(leaf).mesh);
                             sort_unique(keys);
                             return keys;
                         });
    }

    std::uint64_t bytes_given(std::size_t station) const {
        const Station& s = hierarchy_nodes_[station];
        if (s.is_leaf())
            return s.faces * bytes_of_tile_face +
                   s.faces * partition_.vertices() / partition_.faces() * bytes_of_tile_vertex;
        return left_.faces_below(station) * bytes_of_tile_face +
               left_.vertices_below(station) * bytes_of_tile_vertex;
    }

    /// Throws a limit error (E-MEMORY) if tiles are too large to be joined.
    void require_room(std::size_t station) const {
        const std::uint64_t needed = bytes_beside_tiles + bytes_given(station);
        if (needed <= means_.memory) return;
        const Station& s = hierarchy_nodes_[station];
        throw out_of_memory(
            fmt::format(
                "a tile for {} triangles joins {} triangles at once and needs {}, but --memory allows {}",
                grouped(s.faces), grouped(s.is_leaf() ? s.faces : left_.faces_below(station)), sized(needed),
                sized(means_.memory)),
            "give more memory, or simplify before write");
    }

    void settle(std::size_t station) {
        if (hierarchy_nodes_[station].is_leaf())
            settle_cell(station);
        else
            join(station);
    }

    /// The joined cells of a leaf; positions identify its shared vertices.
    Cell whole(const Station& s) const {
        std::vector<Cell> cells;
        for (std::uint32_t leaf = s.leaf; leaf < s.end_leaf; ++leaf) {
            cells.push_back(in_frame(leaf));
            cells.back().home = borders_->homes(leaf, keys_of_places(cells.back().mesh));
        }
        if (cells.size() == 1) return std::move(cells.front());
        return joined(std::move(cells), partition_.tree().nodes[s.node].depth);
    }

    /// Makes a separate pyramid of a cell, or of a few cells.
    void settle_cell(std::size_t station) {
        Cell cell = whole(hierarchy_nodes_[station]);
        std::vector<PyramidTile> pyramid =
            make_pyramid(cell.mesh, {settings_.tiles.most_faces(), frame_.step}, held_of(cell));
        cell.mesh = {};
        left_.put(station, reduced(pyramid.front().mesh, pyramid.front().numbers, cell));
        cell = {};
        std::vector<TreeTile>& tiles = tiles_[station];
        for (const PyramidTile& tile : pyramid)
            tiles.push_back({names_[station] + tile.name, tile.children, tile.error, {}, {}, 0, 0, {}});
        parallel_for(
            tiles.size(), [&](std::size_t t) { encode(std::move(pyramid[t].mesh), tiles[t]); }, 1);
    }

    /// Makes the parent tile of finished tiles.
    void join(std::size_t station) {
        double error = 0;
        for (const std::size_t child : hierarchy_nodes_[station].children)
            error = std::max(error, tiles_[child].front().error);
        const Cell cell = left_.joined_at(station, partition_.tree());
        CoarserTile coarser =
            coarser_tile(cell.mesh, held_of(cell), error, {settings_.tiles.most_faces(), frame_.step});
        left_.put(station, reduced(coarser.mesh, coarser.sources, cell));
        tiles_[station] = {{names_[station], {}, coarser.error, {}, {}, 0, 0, {}}};
        encode(std::move(coarser.mesh), tiles_[station].front());
    }

    void encode(Mesh mesh, TreeTile& tile) {
        const io::Written written = io::tileset::encode_tile(std::move(mesh), tile, {}, settings_, frame_);
        const std::lock_guard lock(guard_);
        for (const io::OutputFile& file : written.files) put_(file);
        for (const Diagnostic& warning : written.warnings) warnings_.emplace(warning.message, warning);
        if (tile.name.empty()) changes_ = written.changes;
    }

    /// Appends the tiles of the station and of its descendants; returns the first's number.
    std::size_t gather(std::size_t station, std::vector<TreeTile>& all) {
        const std::size_t first = all.size();
        for (TreeTile& tile : tiles_[station]) {
            for (std::size_t& child : tile.children) child += first;
            all.push_back(std::move(tile));
        }
        for (const std::size_t child : hierarchy_nodes_[station].children) {
            const std::size_t number = gather(child, all);
            all[first].children.push_back(number);
        }
        return first;
    }

    WrittenTiles finish() {
        std::vector<TreeTile> all;
        gather(hierarchy_nodes_.size() - 1, all);
        WrittenTiles written;
        for (const TreeTile& tile : all)
            written.names.push_back(io::tileset::uri_of_tile(settings_, tile.name));
        io::tileset::TilesetSummary summary = io::tileset::summary_of(all, frame_, settings_);
        written.index = std::move(summary.files);
        written.told = summary.told;
        written.cache = summary.cache;
        written.changes = std::move(changes_);
        for (auto& [message, warning] : warnings_) written.warnings.push_back(std::move(warning));
        return written;
    }

    const Partition& partition_;
    const Transform& transform_;
    io::WriteSettings settings_;
    const CellResources& means_;
    const std::function<void(const io::OutputFile&)>& put_;
    std::vector<Station> hierarchy_nodes_; ///< the root is last
    LeftCells left_;
    std::vector<std::string> names_;           ///< [stations] names
    std::vector<std::vector<TreeTile>> tiles_; ///< [stations] a pyramid for a leaf, otherwise a single tile
    io::TilesetFrame frame_;
    std::optional<Borders> borders_; ///< borders by position
    std::mutex guard_;               ///< protects the members below, and put_
    std::map<std::string, Diagnostic> warnings_;
    AttributeChanges changes_;
};

} // namespace

std::uint64_t memory_for_tiles(std::uint64_t faces, std::uint64_t tile) {
    const std::uint64_t joined = std::min(faces, std::max(faces_of_cell, children_of_tile * tile));
    return bytes_beside_tiles + joined * bytes_of_tile_face + joined / 2 * bytes_of_tile_vertex;
}

WrittenTiles write_tiles(const Partition& partition, const Transform& transform,
                         const io::WriteSettings& settings, const CellResources& means,
                         const std::function<void(const io::OutputFile&)>& put) {
    const std::uint64_t needed = memory_for_tiles(partition.faces(), settings.tiles.most_faces());
    if (needed > means.memory)
        throw out_of_memory(
            fmt::format("tiles of {} triangles need at least {} in cells, but --memory allows {}",
                        grouped(settings.tiles.faces), sized(needed), sized(means.memory)),
            "give more memory, or a smaller tiles.faces");
    return TileMaker(partition, transform, settings, means, put).run();
}

} // namespace facetmill::cells

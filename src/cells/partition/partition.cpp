#include "cells/partition/partition.hpp"

#include "base/progress.hpp"
#include "cells/partition/number_owners.hpp"
#include "cells/sources/pieces.hpp"
#include "cells/sources/unite.hpp"
#include "cells/storage/place_file.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <numeric>
#include <optional>

namespace facetmill::cells {

namespace {

constexpr std::uint32_t resolution = 128; // resolution of the grid: 2 million cells, 8 MB

} // namespace

/// The data needed while faces are distributed to lists.
class Partition::Distribution {
  public:
    Distribution(FaceSource& source, const CellResources& means)
        : source_(source), means_(means), memory_(static_cast<std::size_t>(means.memory / 4)),
          places_(means.scratch) {
        source.scan(memory_);
        grid_.emplace(source.contents().bounds, resolution);
    }
    const CellResources& means() const { return means_; }

    /// Builds the tree. Returns the number of faces.
    std::uint64_t count(Tree& tree, std::uint64_t most) {
        std::uint64_t faces = 0;
        const ProgressScope share(0.05, 0.1);
        source_.each(
            [&](const Vec3& centre, io::Span) {
                const std::size_t place = grid_->cell_of(centre);
                grid_->count(place);
                places_.add(place);
                ++faces;
            },
            memory_);
        if (faces > 0) tree = grid_->split(most);
        return faces;
    }

    /// Adds each face to its leaf's list, and finds the vertices that several lists share.
    void give(SpillFile& records, std::uint64_t faces) {
        const std::uint64_t numbers = source_.vertex_numbers();
        if (numbers > 0 && NumberOwners::fits(numbers, means_.memory))
            owners_.emplace(numbers, means_.scratch, buckets_of_keys(faces, means_.memory), means_.memory);
        PlaceFile::Reader places = places_.finish();
        std::uint64_t given = 0;
        source_.each_record(
            [&](io::Span record) {
                if (given++ >= faces) return;
                const std::uint32_t leaf = grid_->leaf_of(places.next(grid_->cells()));
                records.add(leaf, record);
                if (!owners_) return;
                std::array<std::uint32_t, 3> corners;
                std::memcpy(corners.data(), record.data(), sizeof corners);
                for (const std::uint32_t corner : corners) owners_->add(corner, leaf);
            },
            memory_ / 4);
        if (given != faces)
            io::malformed(source_.name(), 0, "E-CHANGED",
                          fmt::format("there were {} triangles at first, but {} when the file was read again",
                                      faces, given),
                          "run it again while no other program writes to the file");
        grid_.reset();
        records.flush();
    }

    std::optional<NumberOwners>& owners() { return owners_; }
    void end_lists(std::size_t lists) { lists_ = lists; }
    /// Whether the list comes from a divided leaf of the grid, and so received no faces directly.
    bool is_divided(std::size_t list) const { return list >= lists_; }

  private:
    FaceSource& source_;
    const CellResources& means_;
    std::size_t memory_;
    PlaceFile places_;
    std::optional<Grid> grid_;
    std::optional<NumberOwners> owners_;
    std::size_t lists_ = 0;
};

Partition::Partition(std::shared_ptr<FaceSource> source, const CellResources& means, std::uint64_t most)
    : source_(std::move(source)),
      records_(means.scratch, 0, 0,
               source_->vertex_numbers() > 0 ? SpillFile::Records::numbers : SpillFile::Records::bytes) {
    Distribution work(*source_, means);
    distribute(work, most);
    refine(most);
    find_shared(work);
}

Partition::Partition(std::shared_ptr<FaceSource> source, Stored stored)
    : source_(std::move(source)), tree_(std::move(stored.tree)), faces_(stored.faces),
      records_(std::move(stored.records)), list_(tree_.leaves.size()), borders_(std::move(stored.borders)) {
    std::iota(list_.begin(), list_.end(), std::size_t{0});
}

void Partition::store(const std::filesystem::path& records, const std::filesystem::path& borders, bool sync,
                      std::vector<Block>& record_blocks, std::vector<Block>& border_blocks) {
    records_ = records_.stored(records, list_, sync, record_blocks);
    std::iota(list_.begin(), list_.end(), std::size_t{0});
    borders_->store(borders, sync, border_blocks);
}

void Partition::distribute(Distribution& work, std::uint64_t most) {
    faces_ = work.count(tree_, most);
    if (faces_ == 0)
        throw Error(ErrorKind::malformed, "E-EMPTY", fmt::format("'{}' has no faces", source_->name()),
                    "use --partition never to process points and lines in memory");
    // Half of the waiting bytes belong to full lists.
    records_.open_lists(tree_.leaves.size(), static_cast<std::size_t>(work.means().memory / 16));
    work.give(records_, faces_);
    list_.resize(tree_.leaves.size());
    std::iota(list_.begin(), list_.end(), std::size_t{0});
    work.end_lists(list_.size());
}

/// Divides a range of a list's faces as below; a range too large for memory is first halved in its order.
void Partition::divide(std::uint32_t node, std::size_t list, const Range& faces, std::uint64_t most) {
    constexpr std::uint64_t at_once = 4; // cells at once: fixed, so that the result does not depend on memory
    const std::uint64_t size = source_->record_size();
    if (faces.end - faces.begin <= at_once * most)
        return divide(node, records_.read(list, faces.begin * size, (faces.end - faces.begin) * size), most);
    const std::uint64_t middle = faces.begin + (faces.end - faces.begin) / 2;
    divide(tree_.add(node), list, {faces.begin, middle}, most);
    divide(tree_.add(node), list, {middle, faces.end}, most);
}

/// Distributes the faces of a node to leaves below it: halves their centres along the longest side.
void Partition::divide(std::uint32_t node, io::Bytes records, std::uint64_t most) {
    const std::size_t size = source_->record_size(), n = records.size() / size;
    if (n <= most) {
        tree_.make_leaf(node);
        list_.push_back(records_.add_list());
        for (std::size_t f = 0; f < n; ++f)
            records_.add(list_.back(), io::Span(records).subspan(f * size, size));
        records_.flush();
        return;
    }
    const Mesh mesh = source_->piece(records).mesh;
    Box box;
    std::vector<Vec3> centres(n);
    for (std::size_t f = 0; f < n; ++f) {
        centres[f] = centre_of(mesh, f);
        box.add(centres[f]);
    }
    const Vec3 extent = box.extent();
    const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n / 2), order.end(),
                     [&](std::size_t a, std::size_t b) {
                         return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis]
                                                                     : a < b;
                     });
    const auto take = [&](std::size_t begin, std::size_t end) {
        std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                  order.begin() + static_cast<std::ptrdiff_t>(end));
        io::Bytes half;
        half.reserve((end - begin) * size);
        for (std::size_t i = begin; i < end; ++i) {
            const auto record = io::Span(records).subspan(order[i] * size, size);
            half.insert(half.end(), record.begin(), record.end());
        }
        return half;
    };
    io::Bytes low = take(0, n / 2), high = take(n / 2, n);
    records = {};
    divide(tree_.add(node), std::move(low), most);
    divide(tree_.add(node), std::move(high), most);
}

/// Divides leaves for which the grid is too coarse, and renumbers all leaves.
void Partition::refine(std::uint64_t most) {
    const Tree coarse = std::move(tree_);
    tree_ = {};
    const std::vector<std::size_t> lists = std::move(list_);
    list_ = {};
    struct Walk {
        std::uint32_t from, parent;
    };
    std::vector<Walk> waiting{{0, Tree::no_node}};
    while (!waiting.empty()) {
        const auto [from, parent] = waiting.back();
        waiting.pop_back();
        const std::uint32_t node = tree_.add(parent);
        const Tree::Node& old = coarse.nodes[from];
        if (!old.is_leaf()) {
            waiting.push_back({old.child[1], node});
            waiting.push_back({old.child[0], node});
            continue;
        }
        const std::size_t list = lists[old.leaf];
        const std::uint64_t faces = records_.size(list) / source_->record_size();
        if (faces > most) {
            divide(node, list, {0, faces}, most);
            continue;
        }
        tree_.make_leaf(node);
        list_.push_back(list);
    }
}

/// Finds vertices that several leaves share.
void Partition::find_shared(Distribution& work) {
    const CellResources& means = work.means();
    if (!work.owners()) {
        borders_ =
            std::make_unique<Borders>(tree_, means.scratch, means.memory, faces_,
                                      [&](std::uint32_t leaf) { return source_->names(records(leaf)); });
        return;
    }
    NumberOwners& owners = *work.owners();
    std::vector<std::uint32_t> leaf_of(records_.lists(), NumberOwners::nobody);
    for (std::uint32_t leaf = 0; leaf < list_.size(); ++leaf) {
        leaf_of[list_[leaf]] = leaf;
        if (!work.is_divided(list_[leaf])) continue;
        for (const std::uint64_t name : source_->names(records(leaf)))
            owners.add_another(static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(list_[leaf]));
    }
    owners.finish();
    borders_ = std::make_unique<Borders>(tree_, means.scratch, means.memory, owners, leaf_of);
}

Cell Partition::cell(std::uint32_t leaf) const {
    Piece piece = source_->piece(records(leaf));
    std::vector<std::uint8_t> home = borders_->homes(leaf, piece.names);
    return {std::move(piece.mesh), std::move(piece.names), std::move(home)};
}

Cell joined(std::vector<Cell> cells, std::uint8_t depth) {
    Cell all = std::move(cells.front());
    for (std::size_t i = 1; i < cells.size(); ++i) {
        append(all.mesh, cells[i].mesh);
        all.names.insert(all.names.end(), cells[i].names.begin(), cells[i].names.end());
        all.home.insert(all.home.end(), cells[i].home.begin(), cells[i].home.end());
        cells[i] = {};
    }
    std::vector<Index> shared;
    for (Index v = 0; v < all.home.size(); ++v)
        if (all.home[v] != Cell::inner) shared.push_back(v);
    const std::vector<Index> kept = unite(all.mesh, all.names, std::move(shared));
    for (std::size_t v = 0; v < kept.size(); ++v)
        all.home[v] = all.home[kept[v]] >= depth ? Cell::inner : all.home[kept[v]];
    all.home.resize(kept.size());
    return all;
}

Cell reduced(Mesh mesh, const std::vector<Index>& sources, const Cell& from) {
    Cell some;
    some.mesh = std::move(mesh);
    for (const Index source : sources) {
        const std::uint8_t home = source == none ? Cell::inner : from.home[source];
        some.names.push_back(home == Cell::inner ? 0 : from.names[source]);
        some.home.push_back(home);
    }
    return some;
}

} // namespace facetmill::cells

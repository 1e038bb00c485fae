#include "cells/process/split_source.hpp"

#include "base/math/portable_math.hpp"
#include "base/math/random.hpp"
#include "base/progress.hpp"
#include "base/sort_unique.hpp"
#include "cells/partition/cell_border_walk.hpp"
#include "cells/sources/pieces.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::cells {

namespace {

/// Interior points of a face, which no other face has.
std::size_t inner_points(const FaceCut& how) {
    const auto n = static_cast<std::size_t>(how.grid);
    return n < 3 ? 0 : (n - 1) * (n - 2) / 2;
}

Mesh cut(const Mesh& mesh, const FaceCut& how) {
    return how.grid == 0 ? split(mesh, {.method = SplitMethod::midpoint}).mesh
                         : grid_split(mesh, how.grid).mesh;
}

/// Adds the names of new vertices. A new name derives from the names of the edge's ends, or from the face's
/// name, and a number.
void name_new_vertices(const Mesh& whole, const FaceCut& how, const std::vector<std::uint32_t>& numbers,
                       std::vector<std::uint64_t>& names) {
    const std::size_t points = how.grid == 0 ? 1 : static_cast<std::size_t>(how.grid) - 1;
    for (const auto& [a, b] : build_edges(whole).edges) {
        const bool up = names[a] < names[b]; // runs from the lower name, as in every cell
        const std::uint64_t low = names[up ? a : b], high = names[up ? b : a];
        const std::uint64_t edge = hashed(hashed(how.pieces(), low), high);
        for (std::size_t i = 0; i < points; ++i)
            names.push_back(points == 1 ? edge : hashed(edge, up ? i : points - 1 - i));
    }
    for (const std::uint32_t number : numbers)
        for (std::size_t i = 0; i < inner_points(how); ++i)
            names.push_back(hashed(hashed(hashed(how.pieces(), UINT64_MAX), number), i));
}

/// A record has the record of the cut face, the face's number if it has interior points, and the index of
/// the piece.
class SplitSource final : public FaceSource {
  public:
    SplitSource(std::shared_ptr<FaceSource> whole, const FaceCut& how)
        : FaceSource(whole->contents()), whole_(std::move(whole)), how_(how), size_(whole_->record_size()),
          head_(size_ + (inner_points(how) > 0 ? sizeof(std::uint32_t) : 0)) {
        own_contents().vertices = 0; // faces use all vertices
    }

    std::size_t record_size() const override { return head_ + 1; }

    void each(const Take& take, std::size_t memory) override {
        constexpr std::size_t pieces_at_once = 1 << 15;
        const std::size_t at_once = std::max<std::size_t>(1, pieces_at_once / how_.pieces());
        io::Bytes waiting;
        std::uint32_t number = 0; // number of the first waiting face
        whole_->each(
            [&](const Vec3&, io::Span record) {
                waiting.insert(waiting.end(), record.begin(), record.end());
                if (waiting.size() < at_once * size_) return;
                give(waiting, number, take);
                number += static_cast<std::uint32_t>(at_once);
                waiting.clear();
            },
            memory);
        give(waiting, number, take);
    }

    void each_record(const TakeRecord& take, std::size_t memory) override {
        std::uint32_t number = 0;
        io::Bytes piece(head_ + 1);
        whole_->each_record(
            [&](io::Span record) {
                for (std::size_t i = 0; i < how_.pieces(); ++i) take(as_record(record, number, i, piece));
                ++number;
            },
            memory);
    }

    Piece piece(io::Span records) const override {
        io::Bytes parents; // parent records, without consecutive repeats
        std::vector<std::uint32_t> numbers;
        std::vector<Index> faces;
        for (io::Span last; !records.empty(); records = records.subspan(head_ + 1)) {
            const io::Span head = records.first(head_);
            if (!std::equal(head.begin(), head.end(), last.begin(), last.end())) {
                parents.insert(parents.end(), head.begin(),
                               head.begin() + static_cast<std::ptrdiff_t>(size_));
                if (head_ > size_)
                    std::memcpy(&numbers.emplace_back(), head.data() + size_, sizeof(std::uint32_t));
            }
            last = head;
            faces.push_back(static_cast<Index>((parents.size() / size_ - 1) * how_.pieces() +
                                               std::to_integer<std::size_t>(records[head_])));
        }
        Piece whole = whole_->piece(parents);
        name_new_vertices(whole.mesh, how_, numbers, whole.names);
        whole.mesh = cut(whole.mesh, how_);
        return some_faces(whole, faces);
    }

    std::vector<std::uint64_t> names(io::Span records) const override {
        return sorted_once(piece(records).names);
    }

  private:
    /// The record of a piece of a face.
    const io::Bytes& as_record(io::Span parent, std::uint32_t number, std::size_t piece,
                               io::Bytes& to) const {
        std::memcpy(to.data(), parent.data(), size_);
        std::memcpy(to.data() + size_, &number, head_ - size_);
        to[head_] = static_cast<std::byte>(piece);
        return to;
    }

    void give(const io::Bytes& parents, std::uint32_t number, const Take& take) const {
        if (parents.empty()) return;
        const Mesh mesh = cut(whole_->piece(parents).mesh, how_);
        io::Bytes record(head_ + 1);
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            const std::size_t parent = f / how_.pieces();
            take(centre_of(mesh, f),
                 as_record(io::Span(parents).subspan(parent * size_, size_),
                           number + static_cast<std::uint32_t>(parent), f % how_.pieces(), record));
        }
    }

    std::shared_ptr<FaceSource> whole_;
    FaceCut how_;
    std::size_t size_, head_; ///< size of the source's record, and size with the face's number
};

class SpotCount final : public RimVisitor {
  public:
    std::size_t count = 0;
    void read(Cell&) override {}
    void look(const Mesh& mesh, const std::vector<Turn>& turns) override {
        std::vector<std::uint8_t> counted(turns.size());
        for (std::size_t v = 0; v < turns.size(); ++v) counted[v] = turns[v] == Turn::now;
        count += shared_spots(mesh, counted);
    }
};

} // namespace

std::shared_ptr<FaceSource> split_source(std::shared_ptr<FaceSource> whole, const FaceCut& how) {
    if (how.grid == 1) return whole;
    return std::make_shared<SplitSource>(std::move(whole), how);
}

void require_countable(const char* stage, double faces, const char* hint) {
    constexpr double most = UINT32_MAX;
    if (faces > most)
        throw Error(ErrorKind::limit, "E-LIMIT",
                    fmt::format("{}: the result would have about {:.3g} faces, and files that are written "
                                "from cells have at most {:.0f}",
                                stage, faces, most),
                    hint);
}

std::size_t shared_spots(const Partition& partition, const CellResources& means) {
    SpotCount spots;
    walk_cell_borders(partition, means, spots);
    return spots.count;
}

FacetShape shape_of_cells(const Partition& partition, const Transform& transform) {
    FacetShape all{0, pi};
    const std::size_t n = partition.tree().leaves.size();
    for (std::uint32_t leaf = 0; leaf < n; ++leaf, ProgressScope::report_item(leaf, n)) {
        const FacetShape shape = facet_shape(partition.cell(leaf).mesh, transform);
        all.longest_edge = std::max(all.longest_edge, shape.longest_edge);
        all.smallest_angle = std::min(all.smallest_angle, shape.smallest_angle);
    }
    return all;
}

} // namespace facetmill::cells

#include "cells/split_source.hpp"

#include "base/portable_math.hpp"
#include "base/progress.hpp"
#include "base/random.hpp"
#include "cells/rims.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <cstring>

namespace facetmill::cells {

namespace {

constexpr std::size_t pieces = 4; // of a face

/// A piece cut in four, and the names of all of its vertices.
Piece cut(const Piece& whole) {
    Piece cut{split(whole.mesh, {.method = SplitMethod::midpoint}).mesh, whole.names};
    for (const auto& [a, b] : build_edges(whole.mesh).edges) {
        const auto [low, high] = std::minmax(whole.names[a], whole.names[b]);
        cut.names.push_back(hashed(hashed(pieces, low), high));
    }
    return cut;
}

/// These faces, with the vertices that they use, which keep their order.
Piece only(const Piece& all, const std::vector<Index>& faces) {
    std::vector<Index> number(all.mesh.vertex_count(), none), kept;
    for (const Index f : faces)
        for (const Index v : all.mesh.face_wedges(f)) number[v] = 0;
    Piece some;
    for (Index v = 0; v < number.size(); ++v) {
        if (number[v] == none) continue;
        number[v] = static_cast<Index>(kept.size());
        kept.push_back(v);
        some.mesh.positions.push_back(all.mesh.positions[v]);
        some.names.push_back(all.names[v]);
    }
    some.mesh.corners.reserve(3 * faces.size());
    for (const Index f : faces)
        for (const Index v : all.mesh.face_wedges(f)) some.mesh.corners.push_back(number[v]);
    for (Attribute a : all.mesh.attributes) {
        a.select(a.domain == Domain::face ? faces : kept);
        some.mesh.attributes.push_back(std::move(a));
    }
    return some;
}

/// A record is that of the face that is cut, and which of its pieces it is.
class SplitSource final : public FaceSource {
  public:
    explicit SplitSource(std::shared_ptr<FaceSource> whole)
        : FaceSource(whole->contents()), whole_(std::move(whole)), size_(whole_->record_size()) {
        own_contents().vertices = 0; // each is used
    }

    std::size_t record_size() const override { return size_ + 1; }

    void each(const Take& take, std::size_t memory) override {
        constexpr std::size_t at_once = 1 << 13; // faces
        io::Bytes waiting;
        whole_->each(
            [&](const Vec3&, io::Span record) {
                waiting.insert(waiting.end(), record.begin(), record.end());
                if (waiting.size() < at_once * size_) return;
                give(waiting, take);
                waiting.clear();
            },
            memory);
        give(waiting, take);
    }

    Piece piece(io::Span records) const override {
        io::Bytes parents; // each once where it comes several times in a row
        std::vector<Index> faces;
        for (; !records.empty(); records = records.subspan(size_ + 1)) {
            const bool again =
                !parents.empty() && std::memcmp(records.data(), &*parents.end() - size_, size_) == 0;
            if (!again)
                parents.insert(parents.end(), records.begin(),
                               records.begin() + static_cast<std::ptrdiff_t>(size_));
            faces.push_back(static_cast<Index>((parents.size() / size_ - 1) * pieces +
                                               std::to_integer<std::size_t>(records[size_])));
        }
        return only(cut(whole_->piece(parents)), faces);
    }

    std::vector<std::uint64_t> names(io::Span records) const override {
        std::vector<std::uint64_t> names = piece(records).names;
        std::sort(names.begin(), names.end());
        names.erase(std::unique(names.begin(), names.end()), names.end());
        return names;
    }

  private:
    void give(const io::Bytes& parents, const Take& take) const {
        if (parents.empty()) return;
        const Mesh mesh = cut(whole_->piece(parents)).mesh;
        io::Bytes record(size_ + 1);
        for (std::size_t f = 0; f < mesh.face_count(); ++f) {
            std::memcpy(record.data(), parents.data() + f / pieces * size_, size_);
            record[size_] = static_cast<std::byte>(f % pieces);
            Vec3 centre;
            for (std::size_t c = 3 * f; c < 3 * f + 3; ++c)
                centre = centre + mesh.point(static_cast<Index>(c)) / 3;
            take(centre, record);
        }
    }

    std::shared_ptr<FaceSource> whole_;
    std::size_t size_; ///< of a record of the whole
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

std::shared_ptr<FaceSource> split_source(std::shared_ptr<FaceSource> whole) {
    return std::make_shared<SplitSource>(std::move(whole));
}

std::size_t shared_spots(const Partition& partition, const Means& means) {
    SpotCount spots;
    visit_rims(partition, means, spots);
    return spots.count;
}

FacetShape shape_of_cells(const Partition& partition, const Transform& transform) {
    FacetShape all{0, pi};
    const std::size_t n = partition.tree().leaves.size();
    for (std::uint32_t leaf = 0; leaf < n; ++leaf, Share::tell_item(leaf, n)) {
        const FacetShape shape = facet_shape(partition.cell(leaf).mesh, transform);
        all.longest_edge = std::max(all.longest_edge, shape.longest_edge);
        all.smallest_angle = std::min(all.smallest_angle, shape.smallest_angle);
    }
    return all;
}

} // namespace facetmill::cells

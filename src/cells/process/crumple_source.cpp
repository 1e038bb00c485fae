#include "cells/process/crumple_source.hpp"

#include "base/progress.hpp"
#include "cells/partition/numbering.hpp"
#include "cells/sources/pieces.hpp"
#include "geometry/split/split.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::cells {

namespace {

bool follows_the_surface(const Attribute& a) { return a.role == Role::normal || a.role == Role::tangent; }

class CrumpleSource final : public FaceSource {
  public:
    CrumpleSource(std::shared_ptr<FaceSource> still, const CrumpleSettings& settings)
        : FaceSource(still->contents()), still_(std::move(still)), settings_(settings) {
        Box bounds;
        each_batch(*still_, 0, [&](io::Span records) { bounds.add(piece(records).mesh.bounds()); });
        own_contents().bounds = bounds;
        own_contents().vertices = 0; // faces use all vertices
    }

    std::size_t record_size() const override { return still_->record_size(); }

    void each(const Take& take, std::size_t memory) override {
        each_batch(*still_, memory, [&](io::Span records) {
            const Mesh mesh = piece(records).mesh;
            for (std::size_t f = 0; f < mesh.face_count(); ++f)
                take(centre_of(mesh, f), records.subspan(f * record_size(), record_size()));
        });
    }

    void each_record(const TakeRecord& take, std::size_t memory) override {
        still_->each_record(take, memory);
    }

    Piece piece(io::Span records) const override {
        Piece piece = still_->piece(records);
        std::erase_if(piece.mesh.attributes, follows_the_surface);
        const CrumpleMoves moves = crumple_moves(piece.mesh, settings_);
        for (std::size_t v = 0; v < moves.moves.size(); ++v) piece.mesh.positions[v] += moves.moves[v];
        return piece;
    }

    std::vector<std::uint64_t> names(io::Span records) const override { return still_->names(records); }
    std::uint64_t vertex_numbers() const override { return still_->vertex_numbers(); }

  private:
    std::shared_ptr<FaceSource> still_;
    CrumpleSettings settings_;
};

} // namespace

std::shared_ptr<FaceSource> crumple_source(std::shared_ptr<FaceSource> still,
                                           const CrumpleSettings& settings) {
    return std::make_shared<CrumpleSource>(std::move(still), settings);
}

CrumpledCells crumpled_cells(const Partition& partition, const FaceSource& still, const Transform& to_world) {
    CrumpledCells all;
    double squares = 0, edges = 0;
    Numbering numbering(partition.tree());
    const std::size_t n = partition.tree().leaves.size();
    for (std::uint32_t leaf = 0; leaf < n; ++leaf, ProgressScope::report_item(leaf, n)) {
        const Cell cell = partition.cell(leaf);
        const Mesh old = still.piece(partition.records(leaf)).mesh;
        std::vector<Vec3> before, after;
        for (const Index v : numbering.next(cell).fresh) { // each vertex once
            before.push_back(old.positions[v]);
            after.push_back(cell.mesh.positions[v]);
        }
        const MoveSize moves = move_size(before, after, to_world);
        all.moves.largest = std::max(all.moves.largest, moves.largest);
        all.moves.count += moves.count;
        squares += moves.root_mean_square * moves.root_mean_square * static_cast<double>(before.size());
        edges += mean_edge(old, to_world) * static_cast<double>(old.face_count());
    }
    all.moves.root_mean_square = std::sqrt(squares / static_cast<double>(partition.vertices()));
    all.mean_edge = edges / static_cast<double>(partition.faces());
    return all;
}

AttributeChanges crumple_changes(const Mesh& still) {
    AttributeChanges changes = kept_changes(still.attributes);
    for (std::size_t i = 0; i < changes.size(); ++i)
        if (follows_the_surface(still.attributes[i])) {
            changes[i].kind = AttributeChange::Kind::dropped;
            changes[i].why = "it needs all faces of a vertex, but a cell has only some of them";
        }
    return changes;
}

} // namespace facetmill::cells

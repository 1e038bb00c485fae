#pragma once
// A mesh of any size as cells on disk: whole faces, by a k-d tree over their centres, so nothing is cut and
// there are no T-junctions; and which vertices cells have in common.

#include "cells/partition/borders.hpp"
#include "cells/partition/cell_job.hpp"
#include "cells/partition/tree.hpp"
#include "cells/sources/face_source.hpp"
#include "cells/storage/cell_folder.hpp"

namespace facetmill::cells {

/// Where temporary data goes, and how much memory may be taken.
struct CellResources {
    std::filesystem::path scratch;
    std::uint64_t memory = 0; ///< bytes, for everything
    /// Where cells are kept; none: they are temporary, too.
    std::shared_ptr<const CellFolder> kept{};
    std::string key{};            ///< of what was done so far: the program, inputs and options, 64 digits
    std::optional<CellJob> job{}; ///< all there is to do, of which others do the rest
};

/// A part of a mesh. Vertices that other parts have too stay known by name and position.
struct Cell {
    static constexpr std::uint8_t inner = Borders::inner;
    Mesh mesh;                        ///< triangles
    std::vector<std::uint64_t> names; ///< [vertices] see Piece
    /// [vertices] The depth of the node of the tree that all cells with this vertex have in common; inner:
    /// only this cell has it. So within a node of a depth below it is shared with others outside.
    std::vector<std::uint8_t> home;
};

/// Faces that a cell has at the most, but where one place of a grid has more than memory takes.
inline constexpr std::uint64_t faces_of_cell = std::uint64_t{1} << 16;

class Partition {
  public:
    /// Scans the source and reads its faces twice. The cells depend on the mesh and `most` only, never on
    /// memory.
    Partition(std::shared_ptr<FaceSource> source, const CellResources& means,
              std::uint64_t most = faces_of_cell);

    /// What there is of a partition beside its source.
    struct Stored {
        Tree tree;
        std::uint64_t faces = 0;
        SpillFile records; ///< [leaves]
        std::unique_ptr<Borders> borders;
    };
    Partition(std::shared_ptr<FaceSource> source, Stored stored);
    /// Puts records and borders into files with names, where they are read from then on; the blocks are those
    /// of the leaves.
    void store(const std::filesystem::path& records, const std::filesystem::path& borders, bool sync,
               std::vector<Block>& record_blocks, std::vector<Block>& border_blocks);

    const Tree& tree() const { return tree_; }
    const FaceSource& source() const { return *source_; }
    std::shared_ptr<FaceSource> shared_source() const { return source_; }
    std::uint64_t faces() const { return faces_; }
    std::uint64_t faces_of(std::uint32_t leaf) const {
        return records_.size(list_[leaf]) / source_->record_size();
    }
    std::uint64_t vertices() const { return borders_->count(); } ///< that faces use
    /// The faces of a leaf, as the source has them. Any thread. Throws output (E-SCRATCH).
    io::Bytes records(std::uint32_t leaf) const { return records_.read(list_[leaf]); }
    /// Any thread. Throws output (E-SCRATCH).
    Cell cell(std::uint32_t leaf) const;

  private:
    class Distribution;
    void distribute(Distribution& work, std::uint64_t most);
    struct Range {
        std::uint64_t begin, end;
    };
    void divide(std::uint32_t node, std::size_t list, const Range& faces, std::uint64_t most);
    void divide(std::uint32_t node, io::Bytes records, std::uint64_t most);
    void refine(std::uint64_t most);
    void find_shared(Distribution& work);

    std::shared_ptr<FaceSource> source_;
    Tree tree_;
    std::uint64_t faces_ = 0;
    SpillFile records_;                ///< by list
    std::vector<std::size_t> list_;    ///< [leaves] of records_
    std::unique_ptr<Borders> borders_; ///< by names of vertices
};

/// The cells as one, vertices that they share joined. depth: of the node that they make up together.
Cell joined(std::vector<Cell> cells, std::uint8_t depth);

/// What a cell became: a mesh with the names and homes of those vertices that are shared. sources: [vertices]
/// of the mesh, those of the cell, or none.
Cell reduced(Mesh mesh, const std::vector<Index>& sources, const Cell& from);

} // namespace facetmill::cells

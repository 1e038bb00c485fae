#pragma once
// Stores a mesh of any size as cells on disk, with the vertices that cells share. A k-d tree over face
// centres assigns whole faces to cells, so no face is cut and T-junctions cannot occur.

#include "cells/partition/borders.hpp"
#include "cells/partition/cell_job.hpp"
#include "cells/partition/tree.hpp"
#include "cells/sources/face_source.hpp"
#include "cells/storage/cell_folder.hpp"

namespace facetmill::cells {

/// The folder of temporary data and the memory limit.
struct CellResources {
    std::filesystem::path scratch;
    std::uint64_t memory = 0; ///< bytes, for the whole process
    /// The folder of kept cells; null: cells are temporary.
    std::shared_ptr<const CellFolder> kept{};
    std::string key{}; ///< key of the steps so far (the program, inputs and options), 64 digits
    std::optional<CellJob>
        job{}; ///< empty: this process does all work; otherwise other processes do the rest
};

/// A part of a mesh. Name and position identify vertices that it shares with other parts.
struct Cell {
    static constexpr std::uint8_t inner = Borders::inner;
    Mesh mesh;                        ///< triangles
    std::vector<std::uint64_t> names; ///< [vertices] see Piece
    /// [vertices] The depth of the lowest common node of all cells with this vertex; inner: only this cell
    /// has it. A node deeper than that shares the vertex with cells outside.
    std::vector<std::uint8_t> home;
};

/// The maximum number of faces in a cell, except where a single grid cell has more than memory holds.
inline constexpr std::uint64_t faces_of_cell = std::uint64_t{1} << 16;

class Partition {
  public:
    /// Scans the source and reads its faces twice. The cells depend only on the mesh and `most`, not on
    /// memory.
    Partition(std::shared_ptr<FaceSource> source, const CellResources& means,
              std::uint64_t most = faces_of_cell);

    /// The data of a partition besides its source.
    struct Stored {
        Tree tree;
        std::uint64_t faces = 0;
        SpillFile records; ///< [leaves] records
        std::unique_ptr<Borders> borders;
    };
    Partition(std::shared_ptr<FaceSource> source, Stored stored);
    /// Moves records and borders into named files and reads them from these files afterwards. Returns the
    /// blocks of the leaves.
    void store(const std::filesystem::path& records, const std::filesystem::path& borders, bool sync,
               std::vector<Block>& record_blocks, std::vector<Block>& border_blocks);

    const Tree& tree() const { return tree_; }
    const FaceSource& source() const { return *source_; }
    std::shared_ptr<FaceSource> shared_source() const { return source_; }
    std::uint64_t faces() const { return faces_; }
    std::uint64_t faces_of(std::uint32_t leaf) const {
        return records_.size(list_[leaf]) / source_->record_size();
    }
    std::uint64_t vertices() const { return borders_->count(); } ///< number of vertices that faces use
    /// The faces of a leaf as the source's records. Thread-safe. Throws an output error (E-SCRATCH).
    io::Bytes records(std::uint32_t leaf) const { return records_.read(list_[leaf]); }
    /// Thread-safe. Throws an output error (E-SCRATCH).
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
    SpillFile records_;                ///< records by list
    std::vector<std::size_t> list_;    ///< [leaves] their lists in records_
    std::unique_ptr<Borders> borders_; ///< borders by vertex names
};

/// Joins the cells and merges the vertices that they share. depth: the depth of the node that they form
/// together.
[[nodiscard]] Cell joined(std::vector<Cell> cells, std::uint8_t depth);

/// The cell after processing: the mesh, with the names and homes of its shared vertices. sources: [vertices
/// of the mesh] the cell's vertices, or none.
[[nodiscard]] Cell reduced(Mesh mesh, const std::vector<Index>& sources, const Cell& from);

} // namespace facetmill::cells

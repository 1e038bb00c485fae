#pragma once
// Cuts triangles into pieces while reading them; stores nothing.

#include "cells/partition/partition.hpp"
#include "geometry/split/split.hpp"

namespace facetmill::cells {

/// The cut, which is the same for all faces.
struct FaceCut {
    /// Pieces per edge, as in grid_split. 0: SplitMethod::midpoint, whose pieces have a different order than
    /// a grid of 2.
    int grid = 0;
    static constexpr int most = 16;
    std::size_t pieces() const {
        return grid == 0 ? 4 : static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid);
    }
};

/// The pieces of the source's faces, in order, with attributes, as after a single pass of split. A new
/// vertex is named after the ends of its edge, so cells agree on shared vertices. Returns the source itself
/// if the grid is 1. The grid must be at most FaceCut::most.
[[nodiscard]] std::shared_ptr<FaceSource> split_source(std::shared_ptr<FaceSource> whole,
                                                       const FaceCut& how = {});

/// Throws a limit error (E-LIMIT) for more faces than formats can count.
void require_countable(const char* stage, double faces, const char* hint);

/// Spots where faces share two edges, so that their new edges coincide: SplitResult::shared of a pass.
/// Throws the errors of walk_cell_borders.
[[nodiscard]] std::size_t shared_spots(const Partition& partition, const CellResources& means);

/// The longest edge and the smallest angle of all transformed cells.
[[nodiscard]] FacetShape shape_of_cells(const Partition& partition, const Transform& transform);

} // namespace facetmill::cells

#pragma once
// Triangles cut in pieces as they are read: nothing is stored.

#include "cells/partition/partition.hpp"
#include "geometry/split/split.hpp"

namespace facetmill::cells {

/// How faces are cut, all alike.
struct FaceCut {
    /// Pieces of an edge, as grid_split has them; 0: SplitMethod::midpoint, whose pieces of a face have
    /// another order than those of a grid of 2.
    int grid = 0;
    static constexpr int most = 16;
    std::size_t pieces() const {
        return grid == 0 ? 4 : static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid);
    }
};

/// The faces of the source, each in pieces, in its order: what split makes of the mesh in one pass,
/// attributes too. A new vertex is known by the names of its edge's two ends, so what faces share they share
/// in any cell. The source itself where it is cut in one. The grid must be FaceCut::most at most.
std::shared_ptr<FaceSource> split_source(std::shared_ptr<FaceSource> whole, const FaceCut& how = {});

/// Throws limit (E-LIMIT): more faces than formats can count.
void require_countable(const char* stage, double faces, const char* hint);

/// Spots where faces share two edges, so that new edges of theirs coincide: SplitResult::shared of a pass.
/// Throws as walk_cell_borders.
std::size_t shared_spots(const Partition& partition, const CellResources& means);

/// The longest edge and the smallest angle of all cells where the transform puts them.
FacetShape shape_of_cells(const Partition& partition, const Transform& transform);

} // namespace facetmill::cells

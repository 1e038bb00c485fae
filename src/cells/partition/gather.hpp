#pragma once
// Some faces of cells, in memory.

#include "cells/partition/partition.hpp"

#include <functional>

namespace facetmill::cells {

/// These faces of the cell, ascending, with the vertices that they use.
Cell with_faces(Cell cell, const std::vector<Index>& faces);

/// The faces that keep chooses by their corners, as one mesh. Vertices are in the order of their names: of a
/// PLY in that of the file. keep is called from one thread. Throws limit (E-MEMORY) when they are more than
/// memory takes.
Mesh gathered(const Partition& partition,
              const std::function<bool(const Vec3&, const Vec3&, const Vec3&)>& keep,
              const CellResources& means);

/// The faces of the source for which weight is not 0, in its order, without attributes. Throws limit
/// (E-MEMORY) when the weights together are more faces than memory takes.
Mesh gathered(FaceSource& source,
              const std::function<std::size_t(const Vec3&, const Vec3&, const Vec3&)>& weight,
              const CellResources& means);

} // namespace facetmill::cells

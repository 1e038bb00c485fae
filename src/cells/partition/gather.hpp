#pragma once
// Gathers selected faces of cells in memory.

#include "cells/partition/partition.hpp"

#include <functional>

namespace facetmill::cells {

/// These faces of the cell, ascending, with their vertices.
[[nodiscard]] Cell with_faces(Cell cell, const std::vector<Index>& faces);

/// The faces whose corners `keep` accepts, as a single mesh. Vertices are sorted by name, which is the
/// file's order for PLY. A single thread calls keep. Throws a limit error (E-MEMORY) if the faces exceed
/// memory.
[[nodiscard]] Mesh gathered(const Partition& partition,
                            const std::function<bool(const Vec3&, const Vec3&, const Vec3&)>& keep,
                            const CellResources& means);

/// The faces of the source with nonzero weight, in its order, without attributes. Throws a limit error
/// (E-MEMORY) if the sum of the weights, taken as faces, exceeds memory.
[[nodiscard]] Mesh gathered(FaceSource& source,
                            const std::function<std::size_t(const Vec3&, const Vec3&, const Vec3&)>& weight,
                            const CellResources& means);

} // namespace facetmill::cells

#pragma once
// The input of plane sections from a mesh in cells.

#include "cells/partition/partition.hpp"
#include "geometry/section/section.hpp"

namespace facetmill::cells {

/// Like extent_along, for cells.
[[nodiscard]] Extent extent_of_cells(const Partition& partition, const Plane& plane,
                                     const Transform& to_world);

/// The faces that the planes may cut, as a single mesh; section() gives the same result for it as for all
/// faces. Faces and vertices keep the order of the source, so that contours begin at the same points. For
/// STL and glTF the vertex order may differ, which changes the last digits of points. Reads the source once.
/// Throws a limit error (E-MEMORY) if the faces exceed memory.
[[nodiscard]] Mesh faces_at_planes(const Partition& partition, const SectionSettings& settings,
                                   const CellResources& means);

} // namespace facetmill::cells

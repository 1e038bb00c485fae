#pragma once
// What plane sections need of a mesh in cells.

#include "cells/partition/partition.hpp"
#include "geometry/section/section.hpp"

namespace facetmill::cells {

/// As extent_along, of the cells.
Extent extent_of_cells(const Partition& partition, const Plane& plane, const Transform& to_world);

/// The faces that the planes may cut, as one mesh: section() gives the same of it as of all faces. They and
/// their vertices are in the order of the source, so that contours begin where they do in memory; of STL and
/// glTF the order of vertices may be another, which moves points in the last digit. The source is read once.
/// Throws limit (E-MEMORY) when they are more than memory takes.
Mesh faces_at_planes(const Partition& partition, const SectionSettings& settings, const CellResources& means);

} // namespace facetmill::cells

#pragma once
// Triangles cut in four at the middles of their edges, as they are read: nothing is stored.

#include "cells/partition.hpp"
#include "geometry/split/split.hpp"

namespace facetmill::cells {

/// The faces of the source, each as four, in its order: what split with SplitMethod::midpoint makes of the
/// mesh in one pass, attributes too. A new vertex is known by the names of its edge's two ends, so what faces
/// share they share in any cell.
std::shared_ptr<FaceSource> split_source(std::shared_ptr<FaceSource> whole);

/// Spots where faces share two edges, so that new edges of theirs coincide: SplitResult::shared of a pass.
/// Throws as visit_rims.
std::size_t shared_spots(const Partition& partition, const Means& means);

/// The longest edge and the smallest angle of all cells where the transform puts them.
FacetShape shape_of_cells(const Partition& partition, const Transform& transform);

} // namespace facetmill::cells

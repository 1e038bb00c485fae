#pragma once
// The results of measure for a mesh in cells.

#include "cells/partition/partition.hpp"
#include "geometry/measure/measure.hpp"

namespace facetmill::cells {

struct CellMeasures {
    MassResult mass;
    FaceResult faces; ///< without face areas
    EdgeResult edges;
    CurvatureResult curvature; ///< without values at vertices
};

/// The measures of the transformed cells. Counts, minima, maxima and medians equal the mesh in memory. Sums
/// are in cell order, so their last digits may differ, and so may the curvature at a vertex. Writes all
/// numbers to the scratch folder: about 70 bytes per triangle. Throws the errors of inspect_cells.
[[nodiscard]] CellMeasures measure_cells(const Partition& partition, const Transform& transform,
                                         const CellResources& means, const EdgeSettings& settings);

} // namespace facetmill::cells

#pragma once
// What measure tells of a mesh, of one in cells.

#include "cells/partition/partition.hpp"
#include "geometry/measure/measure.hpp"

namespace facetmill::cells {

struct CellMeasures {
    MassResult mass;
    FaceResult faces; ///< without areas of faces
    EdgeResult edges;
    CurvatureResult curvature; ///< without values at vertices
};

/// The measures of the cells where the transform puts them. Counts, minima, maxima and medians are those of
/// the mesh in memory; what is a sum is one in the order of the cells, so it may differ in the last digits,
/// and so may the curvature at a vertex. All numbers are written to the scratch folder: about 70 bytes for a
/// triangle. Throws as inspect_cells.
CellMeasures measure_cells(const Partition& partition, const Transform& transform, const CellResources& means,
                           const EdgeSettings& settings);

} // namespace facetmill::cells

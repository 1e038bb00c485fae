#pragma once
// Triangles whose vertices are displaced as they are read: nothing is stored.

#include "cells/partition/partition.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/edit/moved.hpp"

namespace facetmill::cells {

/// The faces of the source with their vertices where crumple puts them: noise is of places, so each cell
/// finds the same by itself. direction and boundary must be free and the mask empty. Normals and tangents,
/// which need all faces of a vertex, are left out. Reads the source once. Throws as crumple.
std::shared_ptr<FaceSource> crumple_source(std::shared_ptr<FaceSource> still,
                                           const CrumpleSettings& settings);

/// What became of the vertices of a partition of a crumple_source, and the mean edge that they had.
struct CrumpledCells {
    MoveSize moves;
    double mean_edge = 0;
};
CrumpledCells crumpled_cells(const Partition& partition, const FaceSource& still, const Transform& to_world);

/// What crumple_source does to the attributes of a mesh.
AttributeChanges crumple_changes(const Mesh& still);

} // namespace facetmill::cells

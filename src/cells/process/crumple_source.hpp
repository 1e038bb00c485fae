#pragma once
// Displaces the vertices of triangles while reading them; stores nothing.

#include "cells/partition/partition.hpp"
#include "geometry/crumple/crumple.hpp"
#include "geometry/edit/moved.hpp"

namespace facetmill::cells {

/// The source's faces with vertices displaced by crumple. Noise depends on positions, so each cell computes
/// the same values independently. direction and boundary must be free and the mask empty. Drops normals and
/// tangents, which need all faces of a vertex. Reads the source once. Throws the errors of crumple.
[[nodiscard]] std::shared_ptr<FaceSource> crumple_source(std::shared_ptr<FaceSource> still,
                                                         const CrumpleSettings& settings);

/// The displacements of the vertices in a partition of a crumple_source, and the original mean edge length.
struct CrumpledCells {
    MoveSize moves;
    double mean_edge = 0;
};
[[nodiscard]] CrumpledCells crumpled_cells(const Partition& partition, const FaceSource& still,
                                           const Transform& to_world);

/// The changes that crumple_source makes to the attributes of a mesh.
[[nodiscard]] AttributeChanges crumple_changes(const Mesh& still);

} // namespace facetmill::cells

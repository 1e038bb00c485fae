#pragma once
// Simplification of a mesh that is larger than memory: cell by cell, then two to four cells as one, and so on
// up to the whole.
//
// What cells share with others outside of the node that is simplified is held, vertices and edges, and is
// inside at a node above; so no border is left to see, a closed surface stays closed and a manifold one
// manifold. The nodes and their targets depend on the mesh and the target alone.

#include "cells/partition/partition.hpp"
#include "geometry/simplify/simplify.hpp"

namespace facetmill::cells {

struct HierarchyResult {
    Mesh mesh;
    AttributeChanges changes;
    double error = 0; ///< the largest of the cells' plus that of each join above: bounds any path
    SimplifyResult::Stop stop = SimplifyResult::Stop::nothing;
    SimplifyResult::Blocked blocked;
    std::size_t collapses = 0, turned = 0, cells = 0, levels = 0;
    std::uint64_t faces_before = 0;
    double area_before = 0; ///< where the transform puts the mesh
};

/// Why these settings need the whole mesh at once, in words; none when they do not.
std::optional<std::string> why_not_in_cells(const SimplifySettings& settings);

/// Bytes that a simplification of a mesh of so many faces in cells takes when the result has `target`: at
/// least, with one worker.
std::uint64_t memory_for_cells(std::uint64_t faces, std::uint64_t target);
/// ... and in memory, with loading and writing.
std::uint64_t memory_in_core(std::uint64_t faces);

/// Simplifies the cells to the settings' faces or ratio. Throws limit (E-MEMORY) when memory_for_cells is
/// more than there is; output (E-SCRATCH, E-SPACE).
HierarchyResult simplify_cells(const Partition& partition, const SimplifySettings& settings,
                               const CellResources& means, const Transform& transform = {});

/// Does what means.job has to do of that, and leaves its stamp in means.kept. Throws as simplify_cells.
void simplify_job(const Partition& partition, const SimplifySettings& settings, const CellResources& means,
                  const Transform& transform);

} // namespace facetmill::cells

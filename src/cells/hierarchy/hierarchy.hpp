#pragma once
// Simplification of a mesh larger than memory: first each cell, then two to four cells joined, and so on up
// to the whole.
//
// Vertices and edges shared with cells outside the node are held during its simplification. They become free
// at a node above, where all their cells are joined. No seams remain visible, closed surfaces stay closed
// and manifold surfaces stay manifold. Nodes and their targets depend on the mesh and the target alone.

#include "cells/partition/partition.hpp"
#include "geometry/simplify/simplify.hpp"

namespace facetmill::cells {

struct HierarchyResult {
    Mesh mesh;
    AttributeChanges changes;
    double error = 0; ///< bounds any path: the cells' largest error plus each join's
    SimplifyResult::Stop stop = SimplifyResult::Stop::nothing;
    SimplifyResult::Blocked blocked;
    std::size_t collapses = 0, turned = 0, cells = 0, levels = 0;
    std::uint64_t faces_before = 0;
    double area_before = 0; ///< after the transform
};

/// The reason why these settings need the whole mesh in memory, for messages; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_in_cells(const SimplifySettings& settings);

/// The minimum memory in bytes, with one worker, to simplify a mesh of `faces` faces in cells to `target`
/// faces.
[[nodiscard]] std::uint64_t memory_for_cells(std::uint64_t faces, std::uint64_t target);
/// The memory to do the same in memory, with loading and writing.
[[nodiscard]] std::uint64_t memory_in_core(std::uint64_t faces);

/// Simplifies the cells to the settings' faces or ratio. Throws limit (E-MEMORY) if memory_for_cells exceeds
/// the available memory; output (E-SCRATCH, E-SPACE).
[[nodiscard]] HierarchyResult simplify_cells(const Partition& partition, const SimplifySettings& settings,
                                             const CellResources& means, const Transform& transform = {});

/// Does the part of simplify_cells that belongs to means.job, and writes its stamp to means.kept. Throws as
/// simplify_cells.
void simplify_job(const Partition& partition, const SimplifySettings& settings, const CellResources& means,
                  const Transform& transform);

} // namespace facetmill::cells

#pragma once
// Simplifies a mesh larger than memory: first each cell, then two to four cells joined, and so on up to the
// whole mesh.
//
// Vertices and edges shared with cells outside the node are held during its simplification. They become free
// at a node above, where all their cells are joined. No seams remain visible, closed surfaces stay closed
// and manifold surfaces stay manifold. Nodes and their targets depend only on the mesh and the target.

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
    double area_before = 0; ///< area after the transform
};

/// The reason for messages why these settings need the whole mesh in memory; none if they do not.
[[nodiscard]] std::optional<std::string> why_not_in_cells(const SimplifySettings& settings);

/// The minimum memory in bytes, with one worker, to simplify a mesh of `faces` faces in cells to `target`
/// faces.
[[nodiscard]] std::uint64_t memory_for_cells(std::uint64_t faces, std::uint64_t target);
/// The memory needed to simplify in memory, including loading and writing.
[[nodiscard]] std::uint64_t memory_in_core(std::uint64_t faces);

/// Simplifies the cells to the settings' faces or ratio. Throws a limit error (E-MEMORY) if memory_for_cells
/// exceeds the available memory, and an output error (E-SCRATCH, E-SPACE).
[[nodiscard]] HierarchyResult simplify_cells(const Partition& partition, const SimplifySettings& settings,
                                             const CellResources& means, const Transform& transform = {});

/// Does the share of simplify_cells that belongs to means.job, and writes its stamp to means.kept. Throws
/// the errors of simplify_cells.
void simplify_job(const Partition& partition, const SimplifySettings& settings, const CellResources& means,
                  const Transform& transform);

} // namespace facetmill::cells

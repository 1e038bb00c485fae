#pragma once
// A partition that outlives its run: its cells in files of a folder, and a manifest.

#include "cells/partition/partition.hpp"

#include <array>

namespace facetmill::cells {

/// The partition of the source. Takes it from means.kept if it is intact and from the same program, inputs
/// and options (means.key); otherwise makes it, and keeps it in that folder if set. A simplifying job
/// (means.job) makes no partition. It throws an output error (E-SCRATCH), see make_cells_due. It checks
/// cells only when it reads them.
[[nodiscard]] std::unique_ptr<Partition> kept_partition(std::shared_ptr<FaceSource> source,
                                                        const CellResources& means,
                                                        std::uint64_t most = faces_of_cell);

/// The files of a kept partition.
inline constexpr std::array<const char*, 3> kept_files{"facetmill-cells.json", "facetmill-cells.records",
                                                       "facetmill-cells.borders"};

/// For a job in a group, which cannot remake the cells that all jobs read. Removes the manifest, so that the
/// job that makes the cells runs again. Throws an output error (E-SCRATCH).
[[noreturn]] void make_cells_due(const CellFolder& folder, const std::string& why);

} // namespace facetmill::cells

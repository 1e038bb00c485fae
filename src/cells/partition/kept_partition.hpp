#pragma once
// A partition that outlives the run that made it: its cells in files of a folder, and a manifest.

#include "cells/partition/partition.hpp"

#include <array>

namespace facetmill::cells {

/// The partition of the source, taken from means.kept where it is there, of the same program, inputs and
/// options (means.key) and as it was written; else made, and kept there. Without such a folder it is made.
/// A job that simplifies (means.job) makes none: throws output (E-SCRATCH), see make_cells_due; that a cell
/// is as it was written is then seen when it is read.
std::unique_ptr<Partition> kept_partition(std::shared_ptr<FaceSource> source, const CellResources& means,
                                          std::uint64_t most = faces_of_cell);

/// The files that a kept partition has.
inline constexpr std::array<const char*, 3> kept_files{"facetmill-cells.json", "facetmill-cells.records",
                                                       "facetmill-cells.borders"};

/// For a job beside others, which cannot make the cells that all of them read: removes the manifest, so that
/// the job that makes them is due again. Throws output (E-SCRATCH).
[[noreturn]] void make_cells_due(const CellFolder& folder, const std::string& why);

} // namespace facetmill::cells

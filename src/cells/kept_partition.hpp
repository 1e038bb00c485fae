#pragma once
// A partition that outlives the run that made it: its cells in files of a folder, and a manifest.

#include "cells/partition.hpp"

namespace facetmill::cells {

/// The partition of the source, taken from means.kept where it is there, of the same program, inputs and
/// options (means.key) and as it was written; else made, and kept there. Without such a folder it is made.
std::unique_ptr<Partition> kept_partition(std::shared_ptr<FaceSource> source, const Means& means,
                                          std::uint64_t most = faces_of_cell);

} // namespace facetmill::cells

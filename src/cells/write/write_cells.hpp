#pragma once
// Cells as one mesh file, written cell by cell: binary PLY and STL, and GLB of positions.

#include "cells/partition/partition.hpp"
#include "io/codec.hpp"
#include "io/convert.hpp"

#include <functional>

namespace facetmill::cells {

/// Why a file of that format cannot be written cell by cell, in words; none when it can.
std::optional<std::string> why_not_written(const io::Codec& codec, const io::WriteSettings& settings);

struct WritePlace {
    Transform transform; ///< from the cells' own space to the file's
    Vec3 origin; ///< in the cells' own space: where coordinates of a GLB count from, and its node stands
    io::Convention convention; ///< of the file's numbers
};

/// How far rounding to float32 would move a coordinate of the file at most. The cells are read.
double rounding_of(const Partition& partition, const Transform& transform);

/// Hands the file over to put, piece by piece: as the codec writes it, but in the order of the cells, and of
/// a GLB positions only. The cells are read twice, of a GLB three times. Returns
/// how far rounding to float32 moved a coordinate at most. Throws stage (E-RANGE, as the codec), output
/// (E-SCRATCH); and before anything is put, limit (E-SIZE) beyond what the format counts.
double write_cells(const Partition& partition, const WritePlace& place, const io::Codec& codec,
                   const io::WriteSettings& settings, const std::function<void(io::Span)>& put);

} // namespace facetmill::cells

#pragma once
// Writes cells as a single mesh file, cell by cell: binary PLY and STL, and GLB with positions.

#include "cells/partition/partition.hpp"
#include "io/codec.hpp"
#include "io/convert.hpp"

#include <functional>

namespace facetmill::cells {

/// The reason for messages why a file of this format cannot be written cell by cell; none if it can.
[[nodiscard]] std::optional<std::string> why_not_written(const io::Codec& codec,
                                                         const io::WriteSettings& settings);

struct WritePlace {
    Transform transform;       ///< from cell space to file space
    Vec3 origin;               ///< the origin of GLB coordinates and translation of the node, in cell space
    io::Convention convention; ///< convention of the file's numbers
    std::vector<std::shared_ptr<const Document>> documents; ///< metadata, which GLB does not get
};

/// The largest displacement of a file coordinate by rounding to float32. Reads the cells.
[[nodiscard]] double rounding_of(const Partition& partition, const Transform& transform);

/// Passes the file to put, piece by piece. It equals the codec's output, except that cells set the order,
/// and a GLB has only positions. Reads the cells twice, for a GLB three times. Returns the largest
/// displacement of a coordinate by rounding to float32. Throws a stage error (E-RANGE, as the codec), an
/// output error (E-SCRATCH), and, before calling put, a limit error (E-SIZE) beyond the format's counts.
[[nodiscard]] double write_cells(const Partition& partition, const WritePlace& place, const io::Codec& codec,
                                 const io::WriteSettings& settings, const std::function<void(io::Span)>& put);

} // namespace facetmill::cells

#pragma once
// OpenMesh's decimater over plain arrays.

#include "geometry/simplify/simplify.hpp"

#include <span>

namespace facetmill {

/// The allowed collapses of a vertex.
enum class DecimatedVertex : std::uint8_t {
    free,      ///< may be removed, and others may merge into it
    stays,     ///< stays, but others may merge into it
    untouched, ///< is never collapsed
};

/// A collapse along an edge. side: the input number of a face at the edge.
struct Decimation {
    Index kept, removed, side;
};

/// Stops at this many faces or this many vertices, whichever comes first.
struct DecimationGoal {
    std::size_t faces = 0, vertices = 0;
};

/// Collapses edges in the order of OpenMesh's quadric error, to one of their two ends, while the constraints
/// hold. Returns the collapses in order. triangles: [3 faces] vertices. roles: [vertices].
/// constraints.hausdorff: in the units of the positions. Degenerate faces, and faces that would make the
/// surface non-manifold, are left out, and their vertices stay unchanged.
[[nodiscard]] std::vector<Decimation> decimate(std::span<const Vec3> positions,
                                               std::span<const Index> triangles,
                                               std::span<const DecimatedVertex> roles,
                                               const SimplifyConstraints& constraints,
                                               const DecimationGoal& goal);

} // namespace facetmill

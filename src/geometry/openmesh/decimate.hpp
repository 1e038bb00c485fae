#pragma once
// OpenMesh's decimater over plain arrays.

#include "geometry/simplify/simplify.hpp"

#include <span>

namespace facetmill {

/// The allowed collapses of a vertex.
enum class DecimatedVertex : std::uint8_t {
    free,      ///< may go, and others into it
    stays,     ///< others may go into it
    untouched, ///< neither
};

/// A collapse along an edge. side: a face at it, as it was numbered.
struct Decimation {
    Index kept, removed, side;
};

/// At most so many faces, or so many vertices, whichever comes first.
struct DecimationGoal {
    std::size_t faces = 0, vertices = 0;
};

/// Collapses edges in the order of OpenMesh's quadric error, new vertices at one of the two ends, as long as
/// the constraints hold; in the order in which they are made. triangles: [3 faces] vertices. roles: per
/// vertex. constraints.hausdorff: in the units of the positions. Degenerate faces and those that would make
/// the surface non-manifold are left out, with their vertices untouched.
[[nodiscard]] std::vector<Decimation> decimate(std::span<const Vec3> positions,
                                               std::span<const Index> triangles,
                                               std::span<const DecimatedVertex> roles,
                                               const SimplifyConstraints& constraints,
                                               const DecimationGoal& goal);

} // namespace facetmill

#pragma once
// The targets of the work, as goals.

#include "geometry/simplify/features.hpp"
#include "geometry/simplify/methods.hpp"

namespace facetmill::simplification {

/// Throws the first refusal as a usage error, if there is any.
void throw_first(const std::vector<Refusal>& refusals);

/// The face count for a ratio: rounded up, so that 10% of 15 faces is 2.
[[nodiscard]] std::size_t share_of(std::size_t faces, double ratio);

/// The targets of a mesh, or the total targets of several meshes.
struct Targets {
    Goal goal;
    std::size_t by_ratio = 0, by_faces = 0;

    Targets(std::size_t faces, const SimplifySettings& settings);
    /// by_ratio: the number of triangles that the ratio allows.
    Targets(std::size_t by_ratio, std::size_t by_faces, std::size_t vertices);

    /// The target that the number of faces meets.
    SimplifyResult::Stop met(std::size_t faces) const;
    /// Why the work stopped.
    SimplifyResult::Stop reason(const Ended& end) const;
};

/// Why the work is stuck when no collapse is left. It is the error limit, unless borders, seams or
/// non-manifold vertices block more edges. (Topology and flips block an edge only until an edge around it
/// collapses.)
[[nodiscard]] SimplifyResult::Stop stuck_by(const SimplifyResult::Blocked& blocked);

/// Like run_passes, but counts vertices as after coincident borders are separated again. borders: the
/// borders of each member; null if it has none.
void run_passes_separate(std::span<Member> members, std::span<const CoincidentBorders* const> borders,
                         Goal goal);

} // namespace facetmill::simplification

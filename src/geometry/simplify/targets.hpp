#pragma once
// What is asked of the work, as goals.

#include "geometry/simplify/features.hpp"
#include "geometry/simplify/methods.hpp"

namespace facetmill::simplification {

/// Throws usage for the first of them, if there is one.
void throw_first(const std::vector<Refusal>& refusals);

/// The face count that the ratio asks for: rounded up, so that 10% of 15 faces is 2.
std::size_t share_of(std::size_t faces, double ratio);

/// The targets of a mesh, or of several together.
struct Targets {
    Goal goal;
    std::size_t by_ratio = 0, by_faces = 0;

    Targets(std::size_t faces, const SimplifySettings& settings);
    /// by_ratio: triangles that the ratio asks for.
    Targets(std::size_t by_ratio, std::size_t by_faces, std::size_t vertices);

    /// Which of them was met, by the number of faces.
    SimplifyResult::Stop met(std::size_t faces) const;
    /// What stopped the work.
    SimplifyResult::Stop reason(const Ended& end) const;
};

/// What keeps the edges from going when no collapse is left: the limit on their error, where neither borders,
/// seams nor places that are not manifold hold more of them. (Topology and flips hold an edge only as long as
/// those around it stay.)
SimplifyResult::Stop stuck_by(const SimplifyResult::Blocked& blocked);

/// As run_passes, with the vertices counted as they will be once coincident borders are separate again.
/// borders: of each member, null where it has none.
void run_passes_separate(std::span<Member> members, std::span<const CoincidentBorders* const> borders,
                         Goal goal);

} // namespace facetmill::simplification

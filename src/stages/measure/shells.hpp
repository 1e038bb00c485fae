#pragma once
// Shells of a part that lie within or pass through each other, so that their volumes count space twice.

#include "mesh/mesh.hpp"

#include <optional>

namespace facetmill::measure_stage {

/// The volume of the closed mesh after orient (a shell inside another is its cavity) and, for shells that
/// pass through each other, after clean: {self_intersections: union}. None if no two shells can overlap, or
/// if it is the given volume up to rounding. unites: whether the union was needed.
struct SolidVolume {
    double volume = 0;
    bool unites = false;
};
[[nodiscard]] std::optional<SolidVolume> volume_of_overlapping_shells(const Mesh& mesh, double volume);

} // namespace facetmill::measure_stage

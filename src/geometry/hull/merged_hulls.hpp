#pragma once
// Merges convex hulls whose common hull is close to the solid.

#include "geometry/hull/voids.hpp"

namespace facetmill {

/// The hull of some leaves, in cells: a simple hull, which is quick to test.
struct MergedHull {
    std::vector<std::size_t> leaves;
    ConvexSurface hull;
    double volume = 0;
};

struct MergeGoal {
    std::size_t parts = 0; ///< merges until at most this many are left
    double concavity = 0;  ///< and while the common hull of two is this close to the solid, in cells
};

/// Merges the pair whose common hull is least concave, and among those that are close enough, the pair that
/// adds the least volume.
void merge_hulls(const SolidGrid& grid, std::vector<MergedHull>& hulls, const MergeGoal& goal);

} // namespace facetmill

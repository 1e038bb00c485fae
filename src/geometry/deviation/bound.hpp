#pragma once
// The guaranteed part of geometry/deviation/deviation.hpp.

#include "geometry/deviation/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace facetmill {

/// Sets d.bound, and raises d.maximum if the search finds a farther point. d holds the result of sampling.
/// order: the triangles, each near the previous. near: [vertices] a triangle of `to` within d.maximum of
/// each vertex, or none; or empty. within: the distance in question, at least d.maximum.
/// Over a triangle the distance to a convex set is greatest at a corner. So the greatest distance of its
/// corners to one triangle of the other surface bounds it. The distance of a corner plus the longest way to
/// it is another bound. First, all parts thus within `within` are skipped
/// (geometry/deviation/pieces_beyond.hpp). The remaining pieces are cut in four repeatedly, until no bound
/// exceeds it by more than certify_to, or the work is spent. After M. Tang, M. Lee and Y. Kim, "Interactive
/// Hausdorff distance computation for general polygonal models" (2009).
void bound_deviation(DirectedDeviation& d, const Surface& from, std::span<const Index> order,
                     const FaceTree& to, std::span<const Index> near, double within,
                     const DeviationSettings& settings);

} // namespace facetmill

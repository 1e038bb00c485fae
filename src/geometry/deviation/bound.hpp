#pragma once
// Computes the guaranteed bound of geometry/deviation/deviation.hpp.

#include "geometry/deviation/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace facetmill {

/// Sets d.bound, and raises d.maximum if the search finds a farther point. d holds the result of sampling.
/// order: the triangles, each near the previous. near: [vertices] a triangle of `to` within d.maximum of
/// each vertex, or none; or empty. within: the distance in question, at least d.maximum. On a triangle, the
/// distance to a convex set is largest at a corner. So the largest distance of its corners to a single
/// triangle of the other surface is a bound. The distance of a corner plus the largest distance to it is
/// another bound. First, all parts with a bound of at most `within` are skipped
/// (geometry/deviation/pieces_beyond.hpp). The remaining pieces are cut in four repeatedly, until no bound
/// exceeds the maximum by more than certify_to, or the work limit is reached. After M. Tang, M. Lee and Y.
/// Kim, "Interactive Hausdorff distance computation for general polygonal models" (2009).
void bound_deviation(DirectedDeviation& d, const Surface& from, std::span<const Index> order,
                     const FaceTree& to, std::span<const Index> near, double within,
                     const DeviationSettings& settings);

} // namespace facetmill

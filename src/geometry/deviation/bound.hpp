#pragma once
// The guaranteed part of geometry/deviation/deviation.hpp.

#include "geometry/deviation/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace facetmill {

/// Sets d.bound, and raises d.maximum where a point found on the way is farther. d holds what the samples
/// said; order: the triangles, each near the one before; near: [vertices] a triangle of `to` that each is
/// within d.maximum of, or none, or empty; within: at least d.maximum, the distance that is asked about. Over
/// a triangle the distance to a convex set is greatest at a corner, so the greatest distance of its corners
/// to one triangle of the other surface bounds it; so does the distance of a corner plus the longest way to
/// it. First all that is thus within `within` is left out (geometry/deviation/pieces_beyond.hpp). What is
/// left and exceeds it is cut in four, again and again, until nothing exceeds it by more than certify_to, or
/// the work is spent. After M. Tang, M. Lee and Y. Kim, "Interactive Hausdorff distance computation for
/// general polygonal models" (2009).
void bound_deviation(DirectedDeviation& d, const Surface& from, std::span<const Index> order,
                     const FaceTree& to, std::span<const Index> near, double within,
                     const DeviationSettings& settings);

} // namespace facetmill

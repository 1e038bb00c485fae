#pragma once
// The centre of a face, to which some methods of split cut.

#include "mesh/mesh.hpp"

#include <vector>

namespace facetmill {

/// The weight of each corner of a face in its centre: numbers of at least 0 that sum to 1.
struct CentreWeights {
    double even = 0, odd = 0; ///< weights of corners 0, 2 ... and 1, 3 ...
    std::vector<double> own;  ///< weight of every corner, if they differ; otherwise empty
    double of(Index k) const { return own.empty() ? (k % 2 == 0 ? even : odd) : own[k]; }
};

/// The centre of face f. All corners have equal weight (the mean) if the mean sees every edge from its inner
/// side. In a concave quad, only the two ends of the inner diagonal have weight, because its midpoint sees
/// the whole quad. A larger face uses the weights of the centroid of its kernel, the part of the polygon
/// that sees all of it. Without a kernel the mean is used. O(corners) for faces whose mean sees all edges,
/// otherwise O(corners * (kernel corners + 64)).
[[nodiscard]] CentreWeights centre_weights(const Mesh& mesh, Index f);

/// Whether the centre that these weights give is on the outer side of some edge of face f.
bool hides_from_centre(const Mesh& mesh, Index f, const CentreWeights& weights);

} // namespace facetmill

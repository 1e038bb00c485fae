#pragma once
// The point inside a face to which methods of split cut it.

#include "mesh/mesh.hpp"

#include <vector>

namespace facetmill {

/// The weight of each corner of a face in its centre: numbers of at least 0 that sum to 1.
struct CentreWeights {
    double even = 0, odd = 0; ///< of corners 0, 2 ... and 1, 3 ...
    std::vector<double> own;  ///< of every corner, if they differ; else empty
    double of(Index k) const { return own.empty() ? (k % 2 == 0 ? even : odd) : own[k]; }
};

/// The centre of face f. All corners have equal weight (the mean) if the mean sees every edge from its inner
/// side. In a concave quad the two ends of the inner diagonal count, because all of the quad is seen from
/// its middle. A larger face uses the weights of the centroid of its kernel, the part of the polygon from
/// which all of it is seen. Without a kernel the mean is used. O(corners) for faces whose mean sees all,
/// else O(corners * (kernel corners + 64)).
[[nodiscard]] CentreWeights centre_weights(const Mesh& mesh, Index f);

/// Whether the centre that these weights give is on the outer side of some edge of face f.
bool hides_from_centre(const Mesh& mesh, Index f, const CentreWeights& weights);

} // namespace facetmill

#pragma once
// The point inside a face that methods of split cut it to.

#include "mesh/mesh.hpp"

#include <vector>

namespace facetmill {

/// What each corner of a face counts in its centre: numbers of at least 0 that sum to 1.
struct CentreWeights {
    double even = 0, odd = 0; ///< of corners 0, 2 ... and 1, 3 ...
    std::vector<double> own;  ///< of every corner, where they differ; else empty
    double of(Index k) const { return own.empty() ? (k % 2 == 0 ? even : odd) : own[k]; }
};

/// The centre of face f. All corners count the same (the mean), unless the mean does not see every edge from
/// its inner side: in a concave quad the two ends of the inner diagonal count, because all of the quad is
/// seen from its middle; in a larger face the weights are those of the centroid of its kernel, the part of
/// the polygon from which all of it is seen. Without a kernel it is the mean again. O(corners) for faces
/// whose mean sees all, else O(corners * (kernel corners + 64)).
CentreWeights centre_weights(const Mesh& mesh, Index f);

/// Whether some edge of face f is seen from behind from the centre that these weights give.
bool hides_from_centre(const Mesh& mesh, Index f, const CentreWeights& weights);

} // namespace facetmill

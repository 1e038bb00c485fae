#pragma once
// An order for trees without pointers: items are halved across the longest side of the box of their centres,
// again and again, so that every run of 2^k items that begins at a multiple of 2^k lies close together.
//
// Runs along a Hilbert curve (geometry/spatial/hilbert_curve.hpp) are found faster, but they have ragged
// borders. For a tree over 1.1M triangles the order takes 0.3 s of the processor instead of 0.1 s; then
// closest points far from the surface visit 43 nodes instead of 75, and segments take two thirds of the time.
// Choosing the side by the variance of the centres, or by trying all three for the smallest boxes, gained
// nothing more.

#include "mesh/mesh.hpp"

#include <vector>

namespace facetmill {

struct CentredItem {
    float centre[3]; ///< finite
    Index item;      ///< different for each; decides between equal coordinates
};

/// In parallel; the same for any number of threads and any order of the items before. O(n log n).
void sort_in_median_order(std::vector<CentredItem>& items);

} // namespace facetmill

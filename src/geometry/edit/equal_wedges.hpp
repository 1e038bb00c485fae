#pragma once
// Merges equal wedges.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Merges wedges of a vertex with bit-equal attributes into the first. Unindexed glTF and joined tiles have
/// many such wedges. Returns the number of removed wedges. Faces keep their corners' order; vertices and
/// wedges that no face uses stay. O(n log k) for k wedges at a vertex, parallel.
std::size_t merge_equal_wedges(Mesh& mesh);

/// The same; if wedges were merged, then drops elements that no face or line uses. A cloud keeps its points.
std::size_t merge_and_drop_wedges(Mesh& mesh);

} // namespace facetmill

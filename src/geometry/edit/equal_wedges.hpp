#pragma once
// Wedges that have no reason to be apart.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Makes one of the wedges of a vertex that have equal attributes; how many there are less. Faces keep their
/// corners' order.
std::size_t merge_equal_wedges(Mesh& mesh);

} // namespace facetmill

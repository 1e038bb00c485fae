#pragma once
// Meshes in cells, put together again.

#include "cells/partition.hpp"

#include <array>

namespace facetmill::test {

/// All cells as one.
Mesh rejoined(const cells::Partition& partition);

/// The faces of a triangle mesh as sorted triples of positions, which say nothing of numbers and order.
std::vector<std::array<double, 9>> triangles_of(const Mesh& mesh);

} // namespace facetmill::test

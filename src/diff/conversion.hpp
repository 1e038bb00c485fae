#pragma once
// Two scenes that differ by a unit or an up axis alone.

#include "mesh/scene.hpp"

#include <string>

namespace facetmill::report {

/// What to do when the box of the second scene is that of the first times a factor between two units, or with
/// another up axis or otherwise turned about the axes, or both: "the box of B is that of A times 0.001 ...".
/// Empty when it is the same box, or no such conversion makes it so (corners within a hundredth of the
/// diagonal). O(vertices).
std::string conversion_hint(const Scene& a, const Scene& b);

} // namespace facetmill::report

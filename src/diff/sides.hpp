#pragma once
// Compares the orientation of faces in two scenes.

#include "mesh/scene.hpp"

#include <string>

namespace facetmill::report {

/// Whether the second scene, or some of its components, are reversed relative to the first.
struct Turned {
    bool round = false;
    std::string note; ///< the number of components, and the first; empty if the whole was compared
};

/// Compares the signs of volumes, and for open surfaces the sums of area vectors. It compares components
/// (connected across edges, within a part) if both scenes have the same number, areas and positions in the
/// same order. Otherwise it compares the whole scenes. O(n).
[[nodiscard]] Turned turned_round(const Scene& a, const Scene& b);

} // namespace facetmill::report

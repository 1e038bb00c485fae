#pragma once
// Compares the orientation of the faces of two scenes.

#include "mesh/scene.hpp"

#include <string>

namespace facetmill::report {

/// Whether the second scene, or some of its components, are inside out relative to the first.
struct Turned {
    bool round = false;
    std::string note; ///< the number of components and the first; empty if the wholes were compared
};

/// Uses the sign of the volume, and for open surfaces the direction of the summed area vectors. Components
/// (connected over edges, part by part) are compared if both scenes have the same ones in order, with equal
/// areas and positions. Otherwise compares the wholes. O(n).
Turned turned_round(const Scene& a, const Scene& b);

} // namespace facetmill::report

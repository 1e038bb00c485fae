#pragma once
// Which way the faces of two scenes look.

#include "mesh/scene.hpp"

#include <string>

namespace facetmill::report {

/// Whether the second scene, or some components of it, are inside out against the first.
struct Turned {
    bool round = false;
    std::string note; ///< how many components, and the first of them; empty where the whole was looked at
};

/// By the signs of volumes, and of open surfaces by which way the faces look in all. Component by component
/// (connected over edges, part by part) where the scenes have as many components of the same areas at the
/// same places in the same order; else the whole against the whole. O(n).
Turned turned_round(const Scene& a, const Scene& b);

} // namespace facetmill::report

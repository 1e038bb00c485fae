#pragma once
// What always holds for a mesh and a scene; tests check it after every stage, and run --check-invariants does
// too.

#include "mesh/scene.hpp"

namespace facetmill {

/// Every violation, one sentence each: indices out of range, offsets not ascending, faces of fewer than three
/// corners, attributes whose size is not their domain's, positions that are not finite, unnormalised offsets,
/// primitives out of range. Empty when the mesh is as it must be.
std::vector<std::string> broken_invariants(const Mesh& mesh);
std::vector<std::string> broken_invariants(const Scene& scene);

} // namespace facetmill

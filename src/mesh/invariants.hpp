#pragma once
// What always holds for a mesh and a scene; tests check it after every stage, and run --check-invariants does
// too.

#include "mesh/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace facetmill {

/// Every violation, one sentence each: indices out of range, offsets not ascending, faces of fewer than three
/// corners, attributes whose size is not their domain's, positions that are not finite, unnormalised offsets,
/// primitives out of range. Empty when the mesh is as it must be.
std::vector<std::string> broken_invariants(const Mesh& mesh);
std::vector<std::string> broken_invariants(const Scene& scene);

/// The first point with a coordinate that is no finite number; their number when there is none. Parallel.
std::size_t first_not_finite(const std::vector<Vec3>& points);

/// What of a scene is beyond the range of numbers, in words, such as "vertex 7 of part 'cube'" or "the box in
/// world space"; nothing when all is finite.
std::optional<std::string> not_finite(const Scene& scene);

} // namespace facetmill

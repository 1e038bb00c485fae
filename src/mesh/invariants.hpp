#pragma once
// The invariants of a mesh and a scene. Tests check them after every stage, and so does run
// --check-invariants.

#include "mesh/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace facetmill {

/// A sentence for each violation: indices out of range, offsets not ascending, faces of fewer than three
/// corners, attributes of the wrong size for their domain, positions that are not finite, unnormalised
/// offsets, primitives out of range. Empty for a valid mesh.
[[nodiscard]] std::vector<std::string> broken_invariants(const Mesh& mesh);
[[nodiscard]] std::vector<std::string> broken_invariants(const Scene& scene);

/// The first point with a coordinate that is not finite; the number of points if all are finite. Parallel.
[[nodiscard]] std::size_t first_not_finite(const std::vector<Vec3>& points);

/// The first non-finite element of a scene, in words, such as "vertex 7 of part 'cube'" or "the box in world
/// space"; none if all is finite.
[[nodiscard]] std::optional<std::string> not_finite(const Scene& scene);

} // namespace facetmill

#pragma once
// Skinned and morphed parts as a viewer shows them before anything plays.

#include "mesh/scene.hpp"

#include <optional>

namespace facetmill::io {

/// The scene with its skinned parts as the nodes of their document place their joints, and morphed ones by
/// their default weights (those of the node, else of the mesh), as glTF 2.0 has it; weights of joints are
/// made to sum to one. Positions, normals and tangents change, and nothing else: stages work on the bind
/// pose, pictures show this. None where nothing changes. A skin that cannot be read leaves its part as it is.
std::optional<Scene> posed(const Scene& scene);

} // namespace facetmill::io

#pragma once
// Poses skinned and morphed parts as a viewer shows them before any animation plays.

#include "mesh/scene.hpp"

#include <optional>

namespace facetmill::io {

/// The scene with skinned parts posed by the nodes of their document, and morphed parts with their default
/// weights (from the node, otherwise the mesh), as in glTF 2.0. Joint weights are normalised to sum to one.
/// Only positions, normals and tangents change: stages work on the bind pose, pictures show this pose. None
/// if nothing changes. A part with an unreadable skin stays unchanged.
[[nodiscard]] std::optional<Scene> posed(const Scene& scene);

/// The world box of these parts as viewers draw them: the pose of posed(), and animated nodes at their
/// largest scale. Hidden parts and lower levels of detail count only if nothing else is chosen. Without
/// chosen parts: all.
[[nodiscard]] Box posed_bounds(const Scene& scene, std::vector<bool> chosen = {});

} // namespace facetmill::io

#pragma once
// Joins several scenes, for `join: true` after a branch or foreach.

#include "mesh/scene.hpp"

namespace facetmill::pipeline {

/// A scene and the name of its arm.
struct NamedScene {
    std::string name;
    Scene scene;
};

/// Joins all parts, in order. Common materials and documents are kept once. A part whose name is already used
/// gets the name of its arm appended. A part at the node of an earlier part gets a new node. Unit and up axis
/// come from the first scene that has them.
[[nodiscard]] Scene joined(std::vector<NamedScene> scenes);

/// Replaces each part by the results of its arms (results[i] for part i); parts without arms stay.
[[nodiscard]] Scene with_parts_replaced(Scene scene, std::vector<std::vector<NamedScene>> results);

} // namespace facetmill::pipeline

#pragma once
// Several scenes become one: what `join: true` does after a branch or foreach.

#include "mesh/scene.hpp"

namespace facetmill::pipeline {

/// A scene and the name of the arm that made it.
struct NamedScene {
    std::string name;
    Scene scene;
};

/// All parts, in order. Materials and documents that several scenes have are kept once. A part whose name is
/// taken gets that of its arm appended; one that would stand at the node of an earlier part becomes a node of
/// its own. Unit and up are those of the first scene that knows them.
Scene joined(std::vector<NamedScene> scenes);

/// Each part makes way for what its arms made of it (results[i] for part i); parts without arms stay.
Scene with_parts_replaced(Scene scene, std::vector<std::vector<NamedScene>> results);

} // namespace facetmill::pipeline

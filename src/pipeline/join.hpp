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

} // namespace facetmill::pipeline

#pragma once
// Converts a scene of assimp to glTF: metres, y up.

#include "helper.hpp"
#include "scene_files.hpp"

#include <assimp/scene.h>
#include <map>

namespace importers {

/// How the numbers of a scene become metres with y up.
struct Convention {
    double scale = 1;     ///< metres of a unit
    aiMatrix4x4 rotation; ///< turns the up axis to y
};

/// Adds the materials with their textures.
void add_materials(const aiScene& scene, const SceneFiles& files, Glb& glb, Notes& notes);

/// Adds nodes, meshes, skins and animations.
void add_nodes(const aiScene& scene, const Convention& convention, Glb& glb, Notes& notes);

/// Adds the animations. nodes: the glTF node of each name. with_targets: nodes whose meshes have morph
/// targets, with their number.
struct AnimatedNodes {
    std::map<std::string, int> by_name{};
    std::map<std::string, std::pair<int, std::size_t>> with_targets{};
};
void add_animations(const aiScene& scene, const AnimatedNodes& nodes, double scale, Glb& glb, Notes& notes);

} // namespace importers

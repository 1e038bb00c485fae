#pragma once
// The material of baked maps.

#include "geometry/bake/bake.hpp"

#include <string>

namespace facetmill::bake_stage {

struct BakedMaterial {
    std::vector<std::string> maps; ///< their names in glTF
    std::size_t bytes = 0;         ///< of all images
};

/// Gives the selected parts one material with the maps as PNG images, in a new document of the scene.
BakedMaterial put_material(Scene& scene, const std::vector<std::size_t>& parts, const BakeSource& source,
                           const BakedMaps& maps);

/// Removes the materials, textures and images of glTF documents that no part uses any longer.
void drop_unused_materials(Scene& scene);

} // namespace facetmill::bake_stage

#pragma once
// Features and metadata of 3D Tiles: EXT_mesh_features (numbers of features at vertices or in textures) and
// EXT_structural_metadata (tables of their properties). Cesium and OGC, 2022.

#include "base/json.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io::gltf {

/// Whether the vertex attribute of that name numbers features: _FEATURE_ID_0, and _BATCHID of older tiles.
/// Such numbers are never mixed.
bool is_feature_id(std::string_view semantic);

/// What still holds of one of these extensions of a primitive whose mesh has changed; null when nothing does,
/// or for another extension. has: whether the primitive has a vertex attribute. What does not hold any more
/// is added to lost, in words.
Json features_that_hold(const std::string& extension, const Json& value,
                        const std::function<bool(const std::string&)>& has, std::vector<std::string>& lost);

} // namespace facetmill::io::gltf

#pragma once
// Features and metadata of 3D Tiles: EXT_mesh_features (feature numbers at vertices or in textures) and
// EXT_structural_metadata (tables of their properties). Cesium and OGC, 2022.

#include "base/json.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace facetmill::io::gltf {

/// True if the vertex attribute with this name contains feature numbers: _FEATURE_ID_0, or _BATCHID in older
/// tiles. Such numbers are never interpolated.
bool is_feature_id(std::string_view semantic);

/// The part of such an extension that is still valid for a primitive whose mesh has changed. Null if no part
/// is valid, or for other extensions. has: returns whether the primitive has a vertex attribute. Adds
/// descriptions of invalid parts to lost.
[[nodiscard]] Json features_that_hold(const std::string& extension, const Json& value,
                                      const std::function<bool(const std::string&)>& has,
                                      std::vector<std::string>& lost);

} // namespace facetmill::io::gltf

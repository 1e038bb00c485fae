#pragma once
// What a scene's glTF document says beside meshes, without indices into it, so that two files can be
// compared: a texture is its sampler and the digest of its image, an accessor its type and the digest of its
// numbers, a node its name (or its number where it has none).

#include "base/json.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io {

/// The material of the document; null when the material is of none. Throws malformed as reading does.
Json material_contents(const Scene& scene, const Material& material);

/// One entry for each animation, skin, camera and light of the scene's first document: {animations: [...],
/// skins: [...], cameras: [...], lights: [...]}; null when there is no document. Throws malformed as reading
/// does.
Json document_contents(const Scene& scene);

} // namespace facetmill::io

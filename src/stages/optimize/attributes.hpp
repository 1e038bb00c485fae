#pragma once
// Attributes that no material looks at.

#include "io/gltf/tidy.hpp"
#include "mesh/scene.hpp"

#include <functional>

namespace facetmill::optimize_stage {

/// Drops texture coordinates that no texture reads, tangents without a map of normals, and normals of unlit
/// materials (neither beside morph targets, which displace them), where all primitives of the mesh can do
/// without; colours that are white throughout, which change nothing; then wedges that have become equal are
/// one. Colours, skins, morph targets and attributes of one's own stay. Nothing is dropped from a mesh with
/// primitives that have extensions. needs: of a scene's material; none when it is not known. Returns the
/// names.
std::vector<std::string>
drop_unused_attributes(Mesh& mesh,
                       const std::function<std::optional<io::MaterialNeeds>(Index material)>& needs);

} // namespace facetmill::optimize_stage

#pragma once
// Attributes that no material looks at.

#include "io/gltf/optimize/document_optimizer.hpp"
#include "mesh/scene.hpp"

#include <functional>

namespace facetmill::optimize_stage {

struct UnusedKinds {
    bool standard = true; ///< that glTF knows
    bool own = false;     ///< that it does not: of the user's own, which no viewer reads
};

/// Drops texture coordinates that no texture reads, tangents without a map of normals, and normals of unlit
/// materials, with what morph targets displace of them (unless a target would be left with nothing), where
/// all primitives of the mesh can do without; colours that are white throughout, which change nothing;
/// attributes of one's own at vertices; then wedges that have become equal are one. Other colours, skins and
/// morph targets stay. Nothing is dropped from a mesh with primitives that have extensions. needs: of a
/// scene's material; none when it is not known. Returns the names.
std::vector<std::string>
drop_unused_attributes(Mesh& mesh,
                       const std::function<std::optional<io::MaterialNeeds>(Index material)>& needs,
                       UnusedKinds kinds = {});

} // namespace facetmill::optimize_stage

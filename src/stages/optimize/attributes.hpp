#pragma once
// Removes attributes that no material uses.

#include "io/gltf/optimize/document_optimizer.hpp"
#include "mesh/scene.hpp"

#include <functional>

namespace facetmill::optimize_stage {

struct UnusedKinds {
    bool standard = true; ///< attributes that glTF defines
    bool own = false;     ///< custom attributes, which no viewer reads
};

/// Drops unused attributes of a mesh, and returns their names. These are texture coordinates without a
/// texture, tangents without a normal map, and normals of unlit materials, if no primitive of the mesh needs
/// them. A set stays while a later set of the same kind stays. Their morph targets go too, unless a target
/// would become empty. All-white colours and custom vertex attributes are also dropped. Other colours, skins
/// and morph targets stay. Wedges that become equal are merged. A mesh whose primitives have extensions stays
/// unchanged. needs: the needs of a scene's material; none if unknown.
std::vector<std::string>
drop_unused_attributes(Mesh& mesh,
                       const std::function<std::optional<io::MaterialNeeds>(Index material)>& needs,
                       UnusedKinds kinds = {});

} // namespace facetmill::optimize_stage

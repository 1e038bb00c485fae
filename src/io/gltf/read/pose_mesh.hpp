#pragma once
// Moves the vertices of a mesh by morph targets and skins, as in glTF 2.0.

#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io::gltf {

/// The joint matrices of a node's skin, from the bind pose to the world. None without a skin. worlds:
/// [nodes].
[[nodiscard]] std::vector<Transform> joint_matrices(Source& source, std::size_t node,
                                                    const std::vector<Transform>& worlds);
/// The default weights of the targets of a part.
[[nodiscard]] std::vector<double> default_weights(const Json& document, const Part& part);

[[nodiscard]] bool has_targets(const Mesh& mesh);
/// Applies the mesh's morph targets. Returns true if anything moved.
bool morph(Mesh& mesh, const std::vector<double>& weights);
/// Applies the mesh's joints and weights. Returns false if it has none.
bool bend(Mesh& mesh, const std::vector<Transform>& joints);

} // namespace facetmill::io::gltf

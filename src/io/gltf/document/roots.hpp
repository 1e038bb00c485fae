#pragma once
// Moves everything that a document shows.

#include "io/gltf/document/json.hpp"
#include "mesh/transform.hpp"

#include <set>

namespace facetmill::io::gltf {

/// The joints of all skins. Invalid references are skipped.
[[nodiscard]] std::set<std::size_t> joint_nodes(const Json& document);

/// Replaces a node's transform by a matrix.
void put_matrix(Json& node, const Transform& local);

/// Puts new nodes with this transform above the roots of all scenes. Animations and skins move along.
void put_above_roots(Json& document, const Transform& t);

} // namespace facetmill::io::gltf

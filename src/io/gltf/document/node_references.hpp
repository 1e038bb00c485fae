#pragma once
// References to the nodes of a document, and nodes that nothing needs.

#include "io/gltf/document/json.hpp"

#include <functional>
#include <set>

namespace facetmill::io::gltf {

/// Calls visit for references to nodes other than in the hierarchy: skins, animations, levels of detail.
void visit_named_nodes(Json& document, const std::function<void(Json&)>& visit);
void visit_node_references(Json& document, const std::function<void(Json&)>& visit);

/// Erases the emptied nodes without other contents or uses, and ancestors that become empty. Returns the
/// erased nodes; the others are renumbered. Extensions must not name nodes by number.
std::set<std::size_t> erase_empty_nodes(Json& document, const std::set<std::size_t>& emptied);

/// By the old number: the new number, or -1 for removed items.
[[nodiscard]] std::vector<int> numbers_without(std::size_t count, const std::set<std::size_t>& dead);

} // namespace facetmill::io::gltf

#include "io/gltf/document/node_references.hpp"

#include "io/gltf/document/builder.hpp"
#include "io/gltf/document/nodes.hpp"

#include <algorithm>

namespace facetmill::io::gltf {

namespace {

using Visit = std::function<void(Json&)>;

void each_number(Json& owner, const char* key, const Visit& visit) {
    if (!owner.is_object() || !owner.contains(key) || !owner[key].is_array()) return;
    for (Json& one : owner[key])
        if (one.is_number_unsigned()) visit(one);
}

/// Calls call with each node and scene, and the key of its child nodes.
template <class Call>
void each_parent(Json& document, Call&& call) {
    for (const auto& [list, key] : {std::pair("nodes", "children"), {"scenes", "nodes"}})
        if (document.contains(list))
            for (Json& owner : document[list]) call(owner, key);
}

/// Removes dead nodes from a node's children or a scene's nodes.
void drop_children(Json& owner, const char* key, const std::set<std::size_t>& dead) {
    if (!owner.contains(key)) return;
    Json left = Json::array();
    for (const Json& one : owner[key])
        if (!dead.contains(one.get<std::size_t>())) left.push_back(one);
    owner[key] = std::move(left);
    if (owner[key].empty()) owner.erase(key);
}

/// True if the node has only a name and a transform.
bool is_only_a_place(const Json& node) {
    static const std::set<std::string> places = {"name", "translation", "rotation", "scale", "matrix"};
    return std::all_of(node.items().begin(), node.items().end(),
                       [](const auto& member) { return places.contains(member.key()); });
}

} // namespace

void visit_named_nodes(Json& document, const Visit& visit) {
    if (document.contains("skins"))
        for (Json& skin : document["skins"]) {
            each_number(skin, "joints", visit);
            if (index_at(skin, "skeleton")) visit(skin["skeleton"]);
        }
    if (document.contains("animations"))
        for (Json& animation : document["animations"])
            for (Json& channel : animation["channels"])
                if (index_at(channel["target"], "node")) visit(channel["target"]["node"]);
    const Json::json_pointer lod("/extensions/MSFT_lod");
    if (document.contains("nodes"))
        for (Json& node : document["nodes"])
            if (node.contains(lod)) each_number(node[lod], "ids", visit);
}

void visit_node_references(Json& document, const Visit& visit) {
    visit_named_nodes(document, visit);
    each_parent(document, [&](Json& owner, const char* key) { each_number(owner, key, visit); });
}

std::set<std::size_t> erase_empty_nodes(Json& document, const std::set<std::size_t>& emptied) {
    std::set<std::size_t> named, dead;
    visit_named_nodes(document, [&](Json& r) { named.insert(r.get<std::size_t>()); });
    const auto frames = node_frames(document);
    auto order = parents_first(frames);
    std::reverse(order.begin(), order.end());
    std::set<std::size_t> candidates = emptied;
    for (const std::size_t n : order) {
        if (!candidates.contains(n) || named.contains(n)) continue;
        Json& node = document["nodes"][n];
        drop_children(node, "children", dead);
        if (!is_only_a_place(node)) continue;
        dead.insert(n);
        if (frames[n].parent >= 0) candidates.insert(static_cast<std::size_t>(frames[n].parent));
    }
    if (dead.empty()) return dead;
    each_parent(document, [&](Json& owner, const char* key) { drop_children(owner, key, dead); });
    erase_items(document["nodes"], dead, [&](const Visit& visit) { visit_node_references(document, visit); });
    if (document["nodes"].empty()) document.erase("nodes");
    return dead;
}

std::vector<int> numbers_without(std::size_t count, const std::set<std::size_t>& dead) {
    std::vector<int> numbers;
    numbers.reserve(count);
    int next = 0;
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(dead.contains(i) ? -1 : next++);
    return numbers;
}

} // namespace facetmill::io::gltf

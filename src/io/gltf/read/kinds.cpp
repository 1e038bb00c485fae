#include "io/gltf/read/kinds.hpp"

#include "base/math/numbers.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/read/instances.hpp"

#include <fmt/format.h>
#include <map>
#include <optional>
#include <string_view>

namespace facetmill::io::gltf {

namespace {

/// Primitives that get a mesh of their own, and the end of its name.
struct Apart {
    Json primitives;
    std::string suffix;
};

/// The primitives that stay in a mesh, and the primitives that leave it.
struct Groups {
    Json kept = Json::array();
    std::vector<Apart> apart{};
};

Groups groups_of(const JsonCursor& mesh) {
    const Drawn main = kind_of_mesh(mesh);
    const JsonCursor primitives = mesh.at("primitives");
    Groups groups;
    Json of_lines = Json::array();
    std::size_t points = 0;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const Json& primitive = primitives.at(i).json();
        const Drawn kind = kind_of(primitives.at(i));
        if (kind == Drawn::lines && main == Drawn::triangles)
            of_lines.push_back(primitive);
        else if (kind == Drawn::points && (++points > 1 || main != Drawn::points))
            groups.apart.push_back(
                {Json::array({primitive}), points == 1 ? "_points" : fmt::format("_points{}", points)});
        else
            groups.kept.push_back(primitive);
    }
    if (!of_lines.empty()) groups.apart.insert(groups.apart.begin(), {std::move(of_lines), "_lines"});
    return groups;
}

/// The new mesh.
Json mesh_of(Apart& apart, const JsonCursor& before) {
    Json mesh = Json::object();
    const std::string name = before.text_or("name", "");
    if (!name.empty()) mesh["name"] = name + apart.suffix;
    mesh["primitives"] = std::move(apart.primitives);
    if (const auto weights = before.find("weights")) mesh["weights"] = weights->json();
    if (const auto extras = before.find("extras"); extras && extras->json().is_object())
        if (const auto names = extras->find("targetNames")) mesh["extras"]["targetNames"] = names->json();
    return mesh;
}

/// A node with the same transform but another mesh.
Json beside_node(const Json& node, std::size_t mesh, const std::string& suffix, const std::string& path) {
    Json beside = Json::object();
    const std::string name = JsonCursor(node, path).text_or("name", "");
    if (!name.empty()) beside["name"] = name + suffix;
    beside["mesh"] = mesh;
    for (const char* key : {"skin", "weights"})
        if (node.contains(key)) beside[key] = node[key];
    if (const auto extensions = JsonCursor(node, path).find("extensions"))
        if (const auto instances = extensions->find(instancing_extension))
            beside["extensions"][instancing_extension] = instances->json();
    return beside;
}

/// The nodes and meshes that were split off, by their originals.
struct Beside {
    std::map<std::size_t, std::vector<std::size_t>> nodes, meshes;
};

const std::vector<std::size_t>& known(const std::map<std::size_t, std::vector<std::size_t>>& beside,
                                      std::size_t number) {
    static const std::vector<std::size_t> nothing;
    const auto found = beside.find(number);
    return found == beside.end() ? nothing : found->second;
}

/// For a pointer to morph weights (KHR_animation_pointer), the pointers to the weights of the split-off nodes
/// or meshes.
std::vector<std::string> pointers_beside(const std::string& pointer, const Beside& beside) {
    constexpr std::string_view end = "/weights";
    const std::string_view text = pointer;
    std::vector<std::string> all;
    for (const auto& [list, numbers] :
         {std::pair{std::string_view("/nodes/"), &beside.nodes}, {"/meshes/", &beside.meshes}}) {
        if (text.size() < list.size() + end.size() || !text.starts_with(list) || !text.ends_with(end))
            continue;
        const auto number = parse_integer(text.substr(list.size(), text.size() - list.size() - end.size()));
        if (!number) continue;
        for (const std::size_t other : known(*numbers, static_cast<std::size_t>(*number)))
            all.push_back(fmt::format("{}{}{}", list, other, end));
    }
    return all;
}

/// The targets of a channel for the morph weights of the split-off nodes.
std::vector<Json> targets_beside(const JsonCursor& target, const Beside& beside, std::size_t nodes) {
    std::vector<Json> all;
    if (const auto node = target.find("node"); node && target.text_or("path", "") == "weights") {
        for (const std::size_t other : known(beside.nodes, node->index(nodes, "node"))) {
            all.push_back(target.json());
            all.back()["node"] = other;
        }
        return all;
    }
    constexpr const char* extension = "KHR_animation_pointer";
    const auto extensions = target.find("extensions");
    const auto pointed = extensions ? extensions->find(extension) : std::nullopt;
    if (!pointed) return all;
    for (const std::string& pointer : pointers_beside(pointed->text_or("pointer", ""), beside)) {
        all.push_back(target.json());
        all.back()["extensions"][extension]["pointer"] = pointer;
    }
    return all;
}

/// Copies animations of a node's morph weights to its split-off nodes.
void animate_beside(Json& document, const Beside& beside, std::size_t nodes) {
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor channels = item(document, "animations", a).at("channels");
        Json more = Json::array();
        for (std::size_t c = 0; c < channels.size(); ++c)
            for (Json& target : targets_beside(channels.at(c).at("target"), beside, nodes)) {
                more.push_back(channels.at(c).json());
                more.back()["target"] = std::move(target);
            }
        for (Json& channel : more) document["animations"][a]["channels"].push_back(std::move(channel));
    }
}

/// Throws malformed when a scene refers to a missing node.
void check_roots(const Json& document, std::size_t nodes) {
    for (std::size_t s = 0; s < count_of(document, "scenes"); ++s)
        if (const auto roots = item(document, "scenes", s).find("nodes"))
            for (std::size_t i = 0; i < roots->size(); ++i) roots->at(i).index(nodes, "node");
}

} // namespace

bool part_kinds(Json& document) {
    std::map<std::size_t, Groups> split;
    const std::size_t meshes = count_of(document, "meshes");
    for (std::size_t m = 0; m < meshes; ++m)
        if (Groups groups = groups_of(item(document, "meshes", m)); !groups.apart.empty())
            split.emplace(m, std::move(groups));
    if (split.empty()) return false;
    const auto frames =
        node_frames(document); // before adding meshes and nodes, so that nothing refers to them yet
    check_roots(document, frames.size());
    Beside beside;
    for (auto& [m, groups] : split) {
        for (Apart& apart : groups.apart) {
            Json mesh = mesh_of(apart, item(document, "meshes", m));
            beside.meshes[m].push_back(document["meshes"].size());
            document["meshes"].push_back(std::move(mesh));
        }
        document["meshes"][m]["primitives"] = std::move(groups.kept);
    }
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const auto found = split.find(static_cast<std::size_t>(frames[n].mesh));
        if (frames[n].mesh < 0 || found == split.end()) continue;
        for (std::size_t k = 0; k < found->second.apart.size(); ++k) {
            Json node = beside_node(document["nodes"][n], beside.meshes[found->first][k],
                                    found->second.apart[k].suffix, item(document, "nodes", n).path());
            beside.nodes[n].push_back(document["nodes"].size());
            document["nodes"][n]["children"].push_back(document["nodes"].size());
            document["nodes"].push_back(std::move(node));
        }
    }
    animate_beside(document, beside, frames.size());
    return true;
}

} // namespace facetmill::io::gltf

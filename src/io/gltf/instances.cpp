#include "io/gltf/instances.hpp"

#include "base/memory.hpp"
#include "io/gltf/accessor.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

constexpr const char* extension_name = "EXT_mesh_gpu_instancing";

/// An attribute of the instances, as the extension names it and as a node does.
struct Told {
    const char* semantic;
    const char* member;
    int components;
    Attribute numbers{};
};

/// What the instances of a node say of their places; the rest is named in `others`.
std::vector<Told> read_places(Source& source, const Place& attributes, std::size_t& count,
                              std::vector<std::string>& others) {
    std::vector<Told> told = {
        {"TRANSLATION", "translation", 3}, {"ROTATION", "rotation", 4}, {"SCALE", "scale", 3}};
    std::vector<Told> found;
    bool first = true;
    for (const auto& [name, reference] : attributes.json().items()) {
        const Accessor a = accessor(source, Place(reference, attributes.path() + "." + name));
        if (!first && a.count != count) attributes.fail("the attributes of instances have different counts");
        count = a.count;
        first = false;
        const auto known = std::find_if(told.begin(), told.end(), [&, &semantic = name](const Told& t) {
            return semantic == t.semantic;
        });
        if (known == told.end()) {
            others.push_back(name);
            continue;
        }
        if (a.components != known->components)
            attributes.fail(fmt::format("{} must have {} numbers", name, known->components));
        known->numbers = {"", Domain::wedge, Role::generic, a.components, a.normalised, decode(source, a)};
        found.push_back(std::move(*known));
    }
    return found;
}

Json node_of(const std::vector<Told>& told, std::size_t i, const Json& mesh, const std::string& name) {
    Json node = {{"mesh", mesh}};
    if (!name.empty()) node["name"] = name;
    for (const Told& t : told) {
        Json numbers = Json::array();
        for (int c = 0; c < t.components; ++c) numbers.push_back(t.numbers.value(i, c));
        node[t.member] = std::move(numbers);
    }
    return node;
}

} // namespace

void expand_instances(Json& document, const std::vector<Bytes>& buffers, ReadLog& log) {
    constexpr double bytes_of_node = 2000; // with its part
    const Json original = document;
    Source source(original, buffers);
    double needed = 0;
    const std::size_t nodes = count_of(original, "nodes");
    std::vector<std::string> others;
    for (std::size_t n = 0; n < nodes; ++n) {
        const Place node = item(original, "nodes", n);
        const auto extensions = node.find("extensions");
        const auto instancing = extensions ? extensions->find(extension_name) : std::nullopt;
        if (!instancing || !node.find("mesh") || node.find("skin")) continue;
        const Place attributes = instancing->at("attributes");
        if (!attributes.json().is_object()) attributes.fail("expected an object");
        std::size_t count = 0;
        const std::vector<Told> told = read_places(source, attributes, count, others);
        needed += bytes_of_node * static_cast<double>(count);
        require_memory(needed, "making nodes of instances", "leave out instances: expand");
        Json& owner = document["nodes"][n];
        Json children = owner.contains("children") ? owner["children"] : Json::array();
        for (std::size_t i = 0; i < count; ++i) {
            children.push_back(document["nodes"].size());
            document["nodes"].push_back(node_of(told, i, node.at("mesh").json(), node.text_or("name", "")));
        }
        Json& changed = document["nodes"][n]; // the list may have moved
        if (!children.empty()) changed["children"] = std::move(children);
        changed.erase("mesh");
        changed["extensions"].erase(extension_name);
        if (changed["extensions"].empty()) changed.erase("extensions");
    }
    const auto has = [](const Json& node) {
        return node.contains("extensions") && node["extensions"].contains(extension_name);
    };
    if (nodes == 0 || std::any_of(document["nodes"].begin(), document["nodes"].end(), has)) return;
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        remove_name(document, list, extension_name);
        erase_empty(document, list);
    }
    if (!others.empty())
        log.warnings.push_back(
            {Severity::warning,
             "W-INSTANCING",
             fmt::format("instances become nodes, without their attributes {}", fmt::join(others, ", ")),
             {},
             ""});
}

} // namespace facetmill::io::gltf

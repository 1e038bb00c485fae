#include "stages/validate/document_contents.hpp"

#include "base/json.hpp"
#include "io/images/pixels.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace facetmill::validate_stage {

namespace {

using io::Span;

DocumentImage image_of(std::string name, Span bytes) {
    const auto [width, height] = io::image_size(bytes).value_or(std::pair(0, 0));
    return {std::move(name), width, height};
}

std::size_t number_at(const Json& j, const char* name) {
    return j.is_object() && j.contains(name) && j[name].is_number_unsigned() ? j[name].get<std::size_t>() : 0;
}

std::string text_at(const Json& j, const char* name) {
    return j.is_object() && j.contains(name) && j[name].is_string() ? j[name].get<std::string>() : "";
}

/// The list of this name, or an empty list.
Json list_at(const Json& j, const char* name) {
    return j.is_object() && j.contains(name) && j[name].is_array() ? j[name] : Json::array();
}

/// The bytes of an image inside a buffer.
Span bytes_in_buffer(const Document& d, const Json& json, const Json& image) {
    const Json views = list_at(json, "bufferViews");
    const std::size_t v = number_at(image, "bufferView");
    if (v >= views.size()) return {};
    const std::size_t buffer = number_at(views[v], "buffer"), offset = number_at(views[v], "byteOffset"),
                      length = number_at(views[v], "byteLength");
    if (buffer >= d.buffers.size()) return {};
    const Span all(d.buffers[buffer]);
    if (offset > all.size() || length > all.size() - offset) return {};
    return all.subspan(offset, length);
}

void add_images(const Document& d, std::vector<DocumentImage>& images) {
    const Json json = parse_json(d.json, Broken::discarded);
    const Json list = list_at(json, "images");
    std::set<std::string> listed;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string name = text_at(list[i], "name"), uri = text_at(list[i], "uri");
        const auto file = d.files.find(uri);
        const bool inside = list[i].is_object() && list[i].contains("bufferView");
        Span bytes;
        if (inside) bytes = bytes_in_buffer(d, json, list[i]);
        if (!inside && file != d.files.end() && listed.insert(uri).second) bytes = file->second;
        const bool told = !uri.empty() && uri.size() < 200; // excludes data: URIs
        images.push_back(image_of(!name.empty() ? name : told ? uri : fmt::format("image {}", i), bytes));
    }
    for (const auto& [uri, bytes] : d.files)
        if (!listed.contains(uri)) images.push_back(image_of(uri, bytes));
}

} // namespace

std::vector<DocumentImage> images_of(const Scene& scene) {
    std::vector<DocumentImage> images;
    for (const auto& d : scene.documents)
        if (d) add_images(*d, images);
    return images;
}

namespace {

/// Whether a member of a node is a list of numbers other than these.
bool differs(const Json& node, const char* key, const std::vector<double>& usual) {
    if (!node.contains(key)) return false;
    const Json& values = node[key];
    if (!values.is_array() || values.size() != usual.size()) return false;
    for (std::size_t i = 0; i < usual.size(); ++i)
        if (!values[i].is_number() || values[i].get<double>() != usual[i]) return true;
    return false;
}

bool is_moved(const Json& node) {
    return differs(node, "translation", {0, 0, 0}) || differs(node, "rotation", {0, 0, 0, 1}) ||
           differs(node, "scale", {1, 1, 1}) ||
           differs(node, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
}

/// Whether the node or one below it has a mesh. nodes: of the document, which may have cycles.
bool has_mesh(const Json& nodes, std::size_t root) {
    std::vector<std::size_t> open = {root};
    std::set<std::size_t> seen = {root};
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        if (i >= nodes.size() || !nodes[i].is_object()) continue;
        if (nodes[i].contains("mesh")) return true;
        const Json children = list_at(nodes[i], "children");
        for (const Json& child : children)
            if (child.is_number_unsigned() && seen.insert(child.get<std::size_t>()).second)
                open.push_back(child.get<std::size_t>());
    }
    return false;
}

} // namespace

std::vector<std::string> moved_root_nodes(const Scene& scene) {
    std::vector<std::string> names;
    std::size_t all = 0; // nodes at the top
    std::set<int> used;
    for (const Part& part : scene.parts) {
        if (part.document >= 0 && part.node >= 0) {
            used.insert(part.document);
            continue;
        }
        ++all;
        if (!part.transform.identity()) names.push_back(part.name);
    }
    for (const int d : used) {
        const Json json = parse_json(scene.documents[static_cast<std::size_t>(d)]->json, Broken::discarded);
        const Json nodes = list_at(json, "nodes"), scenes = list_at(json, "scenes");
        const std::size_t shown = number_at(json, "scene");
        if (shown >= scenes.size()) continue;
        const Json roots = list_at(scenes[shown], "nodes");
        for (const Json& root : roots) {
            if (!root.is_number_unsigned() || root.get<std::size_t>() >= nodes.size()) continue;
            const Json& node = nodes[root.get<std::size_t>()];
            if (!node.is_object() || !has_mesh(nodes, root.get<std::size_t>())) continue;
            ++all;
            if (is_moved(node))
                names.push_back(node.contains("name") ? text_at(node, "name")
                                                      : fmt::format("nodes[{}]", root.get<std::size_t>()));
        }
    }
    // Several nodes at the top are placed in the scene, which has no transform.
    return all > 1 ? std::vector<std::string>() : names;
}

std::vector<DocumentExtension> extensions_of(const Scene& scene) {
    std::set<std::pair<std::string, std::string>> used;
    for (const auto& d : scene.documents)
        if (d)
            for (const auto& e : list_at(parse_json(d->json, Broken::discarded), "extensionsUsed"))
                if (e.is_string()) used.emplace(e.get<std::string>(), d->name);
    std::vector<DocumentExtension> all;
    all.reserve(used.size());
    for (const auto& [name, document] : used) all.push_back({name, document});
    return all;
}

} // namespace facetmill::validate_stage

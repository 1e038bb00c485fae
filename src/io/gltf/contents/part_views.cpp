// How viewers show the parts of a document: always or not at all, at rest or in motion.

#include "io/gltf/contents/largest_pose.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/read/instances.hpp"
#include "mesh/drawn_box.hpp"
#include "mesh/finite_box.hpp"
#include "mesh/transform.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::io::gltf {

namespace {

/// The values of a track; none if they cannot be read: viewers cannot play such a track either.
std::optional<Attribute> keys_of(Source& source, const JsonCursor& sampler) {
    try {
        const Accessor a = accessor(source, sampler.at("output"));
        if (a.components != 3) return {};
        return Attribute{"", Domain::wedge, Role::generic, 3, a.normalised, decode(source, a)};
    } catch (const Error&) {
        return {};
    }
}

/// Raises the scale to the largest key along each axis.
void add_keys(Source& source, const JsonCursor& sampler, Vec3& scale) {
    const auto read = keys_of(source, sampler);
    if (!read) return;
    const Attribute& keys = *read;
    // Each cubic key has a tangent before and after its value.
    const bool cubic = sampler.text_or("interpolation", "") == "CUBICSPLINE";
    for (std::size_t i = cubic ? 1 : 0; i < keys.size(); i += cubic ? 3 : 1)
        for (std::size_t c = 0; c < 3; ++c) {
            const double key = std::abs(keys.value(i, static_cast<int>(c)));
            if (std::isfinite(key)) scale[c] = std::max(scale[c], key);
        }
}

Vec3 rest_scale(const Json& node) {
    Vec3 scale{1, 1, 1};
    const auto told = node.find("scale");
    for (std::size_t c = 0; told != node.end() && c < 3; ++c) scale[c] = told->at(c).get<double>();
    return scale;
}

} // namespace

std::vector<Transform> largest_worlds(Source& source, const std::vector<NodeFrame>& frames) {
    const Json& document = source.json();
    std::map<std::size_t, Vec3> scales; // of animated nodes, without signs
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor animation = item(document, "animations", a);
        const JsonCursor channels = animation.at("channels");
        const auto samplers = animation.find("samplers");
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto property = animated_property(channels.at(c), frames.size());
            if (!samplers || !property || property->path != "scale") continue;
            const auto sampler = index_at(channels.at(c).json(), "sampler", samplers->size());
            if (!sampler) continue;
            const Json& node = document["nodes"][property->node];
            if (node.contains("matrix")) continue;
            const Vec3 rest = rest_scale(node);
            Vec3& scale =
                scales.try_emplace(property->node, Vec3{std::abs(rest.x), std::abs(rest.y), std::abs(rest.z)})
                    .first->second;
            add_keys(source, samplers->at(*sampler), scale);
        }
    }
    std::vector<Transform> worlds(frames.size());
    for (const std::size_t n : parents_first(frames)) {
        Transform local = frames[n].local;
        if (const auto found = scales.find(n); found != scales.end()) {
            const Json& node = document["nodes"][n];
            const Vec3 rest = rest_scale(node);
            Json unscaled = node;
            unscaled.erase("scale");
            local = local_transform(JsonCursor(unscaled, "nodes"));
            for (auto& row : local.m)
                for (std::size_t c = 0; c < 3; ++c) row[c] *= std::copysign(found->second[c], rest[c]);
        }
        worlds[n] = frames[n].parent < 0 ? local : worlds[static_cast<std::size_t>(frames[n].parent)] * local;
    }
    return worlds;
}

namespace {

/// The state of every node of a document.
struct NodeViews {
    std::vector<NodeFrame> frames;
    std::vector<PartView> of;
};

bool has_content(const Json& node, const char* name, const char* list) {
    const auto extensions = node.find("extensions");
    if (extensions == node.end() || !extensions->contains(name)) return false;
    const Json& extension = (*extensions)[name];
    return extension.contains(list) && !extension[list].empty();
}

/// True if the node's transform also moves a camera, a light or something unknown.
bool has_company(const Json& node) {
    if (node.contains("camera")) return true;
    const auto extensions = node.find("extensions");
    if (extensions == node.end()) return false;
    return std::any_of(extensions->items().begin(), extensions->items().end(), [](const auto& extension) {
        return extension.key() != "MSFT_lod" && extension.key() != instancing_extension &&
               extension.key() != "EXT_instance_features" && extension.key() != "KHR_node_visibility";
    });
}

bool is_invisible(const Json& node) {
    const Json::json_pointer visible("/extensions/KHR_node_visibility/visible");
    return node.contains(visible) && node[visible] == false;
}

/// The nodes whose visibility an animation drives.
std::set<std::size_t> appearing_nodes(const Json& document) {
    std::set<std::size_t> nodes;
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor channels = item(document, "animations", a).at("channels");
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto property = animated_property(channels.at(c), count_of(document, "nodes"));
            if (property && property->path == "extensions/KHR_node_visibility/visible")
                nodes.insert(property->node);
        }
    }
    return nodes;
}

/// The levels of detail that replace other nodes.
std::set<std::size_t> lower_levels(const Json& document) {
    std::set<std::size_t> levels;
    for (std::size_t n = 0; n < count_of(document, "nodes"); ++n) {
        const Json& node = document["nodes"][n];
        if (!has_content(node, "MSFT_lod", "ids")) continue;
        for (const Json& id : node["extensions"]["MSFT_lod"]["ids"])
            if (id.is_number_unsigned()) levels.insert(id.get<std::size_t>());
    }
    return levels;
}

NodeViews views_of(const Document& document) {
    const Json json = parse_document(document.json);
    Source source(json, document.buffers);
    NodeViews views{node_frames(json), {}};
    const auto worlds = largest_worlds(source, views.frames);
    const auto shown = shown_nodes(json);
    const auto animated = animated_nodes(json), appearing = appearing_nodes(json);
    const auto levels = lower_levels(json);
    views.of.resize(views.frames.size());
    for (const std::size_t n : parents_first(views.frames)) {
        const Json& node = json["nodes"][n];
        const int parent = views.frames[n].parent;
        PartView& view = views.of[n];
        if (parent >= 0) view = views.of[static_cast<std::size_t>(parent)];
        view.animated |= animated.contains(n) || appearing.contains(n);
        view.hidden |= !shown[n] || (is_invisible(node) && !appearing.contains(n));
        view.lower_level |= levels.contains(n);
        view.has_levels |= has_content(node, "MSFT_lod", "ids");
        view.instanced = has_content(node, instancing_extension, "attributes");
        view.shares_node = has_company(node);
        view.largest = worlds[n];
    }
    return views;
}

/// The world transform in the largest pose of a part that stages may have moved.
Transform largest_of(const Part& part, const NodeFrame& frame, const Transform& largest) {
    if (part.skinned || largest == frame.world) return part.transform;
    const auto back = part.transform == frame.world ? std::nullopt : inverse(frame.world);
    return back ? part.transform * (*back * largest) : largest;
}

} // namespace

} // namespace facetmill::io::gltf

namespace facetmill::io {

using namespace gltf;

std::vector<PartView> part_views(const Scene& scene) {
    std::map<int, NodeViews> documents;
    std::vector<PartView> views(scene.parts.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
        const Part& part = scene.parts[i];
        views[i].largest = part.transform;
        if (part.document < 0 || part.node < 0) continue;
        auto found = documents.find(part.document);
        if (found == documents.end())
            found = documents
                        .emplace(part.document,
                                 views_of(*scene.documents[static_cast<std::size_t>(part.document)]))
                        .first;
        const auto node = static_cast<std::size_t>(part.node);
        if (node >= found->second.of.size()) continue;
        views[i] = found->second.of[node];
        views[i].largest = largest_of(part, found->second.frames[node], views[i].largest);
    }
    return views;
}

namespace {
Box box_in_world(const Part& part) {
    if (part.transform.identity()) return part.mesh.bounds();
    return box_of_finite(part.mesh.vertex_count(),
                         [&](std::size_t v) { return part.transform.point(part.mesh.positions[v]); });
}

/// Adds the boxes of all instances of parts that are drawn.
void add_instances(const Scene& scene, const std::vector<PartView>& views, Box& shown) {
    const bool any = std::any_of(views.begin(), views.end(),
                                 [](const PartView& view) { return view.instanced && view.is_drawn(); });
    if (!any) return;
    std::size_t exact = std::size_t{1} << 22; // vertices to transform; beyond it, only corners of boxes
    std::map<std::size_t, Box> boxes;         // by part
    for_each_place_of_instances(scene, [&](std::size_t i, const Transform& place, double) {
        if (!views[i].is_drawn()) return;
        const Mesh& mesh = scene.parts[i].mesh;
        if (mesh.vertex_count() <= exact) {
            exact -= mesh.vertex_count();
            return shown.add(drawn_box(mesh, place));
        }
        const auto [known, first] = boxes.try_emplace(i);
        if (first) known->second = drawn_box(mesh);
        shown.add(box_of_corners(known->second, place));
    });
}
} // namespace

Box drawn_bounds(const Scene& scene, const std::vector<PartView>& views) {
    Box shown, all;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        const bool placed = part.document >= 0 && part.node >= 0;
        const Box box = placed ? drawn_box(part.mesh, views[i].largest) : box_in_world(part);
        all.add(box);
        if (views[i].is_drawn()) shown.add(box);
    }
    add_instances(scene, views, shown);
    return shown.empty() ? all : shown;
}

Box drawn_bounds(const Scene& scene) {
    try {
        return drawn_bounds(scene, part_views(scene));
    } catch (const Error&) { // a document whose animations are invalid: viewers cannot play them
        return scene.bounds();
    }
}

} // namespace facetmill::io

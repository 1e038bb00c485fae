// Cameras, lights and nodes without contents move along with a scene that moves as a whole.

#include "base/math/numbers.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/document/roots.hpp"
#include "io/gltf/gltf.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io {

using namespace gltf;

namespace {

constexpr const char* lights_extension = "KHR_lights_punctual";

bool has_camera_or_light(const Json& node) {
    const auto extensions = node.find("extensions");
    return node.contains("camera") || (extensions != node.end() && extensions->contains(lights_extension));
}

/// Nine digits hold a float32 exactly, and hide the rounding of the factor.
void multiply(Json& owner, const char* key, double factor) {
    if (!owner.is_object() || !owner.contains(key) || !owner[key].is_number()) return;
    const double x = owner[key].get<double>() * factor;
    owner[key] = parse_real(fmt::format("{:.9g}", x)).value_or(x);
}

/// Whether KHR_animation_pointer drives numbers of cameras or lights.
bool animates_numbers(const Json& document) {
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor channels = item(document, "animations", a).at("channels");
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const std::string pointer = animation_pointer(channels.at(c));
            if (pointer.starts_with("/cameras/") || pointer.starts_with("/extensions/KHR_lights_punctual/"))
                return true;
        }
    }
    return false;
}

/// The scale of nodes does not apply to these numbers. The light of points falls with the square of the
/// distance, so their intensity grows with it, and the scene looks the same.
void scale_numbers(Json& document, double factor) {
    for (std::size_t c = 0; c < count_of(document, "cameras"); ++c)
        for (const char* kind : {"perspective", "orthographic"})
            if (document["cameras"][c].contains(kind))
                for (const char* key : {"znear", "zfar", "xmag", "ymag"})
                    multiply(document["cameras"][c][kind], key, factor);
    const Json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    if (!document.contains(lights) || !document[lights].is_array()) return;
    for (Json& light : document[lights]) {
        multiply(light, "range", factor);
        if (!light.is_object() || light.value("type", "") == "directional") continue;
        if (!light.contains("intensity")) light["intensity"] = 1.0;
        multiply(light, "intensity", factor * factor);
    }
}

/// Puts a new node with this transform between a node and its parent.
void put_above(Json& document, std::size_t node, const Transform& local) {
    const std::size_t above = document["nodes"].size();
    const auto replace = [&](Json& owner, const char* key) {
        if (owner.contains(key))
            for (Json& child : owner[key])
                if (child == node) child = above;
    };
    for (std::size_t s = 0; s < count_of(document, "scenes"); ++s) replace(document["scenes"][s], "nodes");
    for (std::size_t n = 0; n < above; ++n) replace(document["nodes"][n], "children");
    document["nodes"].push_back({{"children", {node}}});
    put_matrix(document["nodes"][above], local);
}

/// [nodes] nodes that neither draw anything nor have a descendant that does, and that no joint or animation
/// moves. Applications attach things to these places.
std::vector<bool> places(const Json& document, const std::vector<NodeFrame>& frames,
                         const std::set<std::size_t>& animated) {
    std::vector<bool> draws(frames.size()), moved_by_others(frames.size());
    for (const std::size_t joint : joint_nodes(document))
        if (joint < frames.size()) draws[joint] = moved_by_others[joint] = true;
    for (const std::size_t n : animated) moved_by_others[n] = true;
    const std::vector<std::size_t> order = parents_first(frames);
    for (auto n = order.rbegin(); n != order.rend(); ++n) {
        draws[*n] = draws[*n] || frames[*n].mesh >= 0;
        if (draws[*n] && frames[*n].parent >= 0) draws[static_cast<std::size_t>(frames[*n].parent)] = true;
    }
    std::vector<bool> all(frames.size());
    for (const std::size_t n : order) {
        if (frames[n].parent >= 0 && moved_by_others[static_cast<std::size_t>(frames[n].parent)])
            moved_by_others[n] = true;
        all[n] = !draws[n] && !moved_by_others[n];
    }
    return all;
}

/// The transform without the scale of a scene that has grown. Cameras, lights and attached things keep
/// theirs.
Transform without_growth(Transform world, double growth) {
    for (auto& row : world.m)
        for (std::size_t c = 0; c < 3; ++c) row[c] /= growth;
    return world;
}

/// Moves the nodes of cameras and lights, and the nodes in `places`. All other nodes keep their positions in
/// the world.
void move_nodes(Json& document, const Transform& by, double growth) {
    const auto frames = node_frames(document);
    const auto animated = animated_nodes(document);
    const std::vector<bool> is_place = places(document, frames, animated);
    std::vector<Transform> wanted;
    wanted.reserve(frames.size());
    for (const NodeFrame& frame : frames) wanted.push_back(frame.world);
    for (const std::size_t n : parents_first(frames)) {
        if (is_place[n] || (frames[n].mesh < 0 && has_camera_or_light(document["nodes"][n])))
            wanted[n] = without_growth(by * frames[n].world, growth);
        const auto parent = static_cast<std::size_t>(frames[n].parent);
        const bool below = frames[n].parent >= 0;
        if (wanted[n] == frames[n].world && (!below || wanted[parent] == frames[parent].world)) continue;
        const auto up = below ? inverse(wanted[parent]) : Transform{};
        const auto down = animated.contains(n) ? inverse(frames[n].local) : Transform{};
        if (!up || !down) continue;
        if (animated.contains(n))
            put_above(document, n, *up * wanted[n] * *down);
        else
            put_matrix(document["nodes"][n], *up * wanted[n]);
    }
}

/// Gives cameras and lights below scaled roots a node without that scale.
void undo_growth(Json& document, double growth) {
    const std::size_t count = count_of(document, "nodes");
    for (std::size_t n = 0; n < count; ++n) {
        if (!has_camera_or_light(document["nodes"][n])) continue;
        Json below = {{"scale", Json::array({1 / growth, 1 / growth, 1 / growth})}};
        Json& node = document["nodes"][n];
        if (node.contains("camera")) below["camera"] = node["camera"];
        node.erase("camera");
        if (node.contains("extensions") && node["extensions"].contains(lights_extension)) {
            below["extensions"][lights_extension] = node["extensions"][lights_extension];
            node["extensions"].erase(lights_extension);
            if (node["extensions"].empty()) node.erase("extensions");
        }
        node["children"].push_back(document["nodes"].size());
        document["nodes"].push_back(std::move(below));
    }
}

/// Moves all nodes of a document. Its animations play around the new places.
void move_all(Scene& scene, int d, Json& document, const Transform& by, double growth) {
    const auto before = node_frames(document);
    put_above_roots(document, by);
    const auto after = node_frames(document);
    for (Part& part : scene.parts) {
        if (part.document != d || part.node < 0 || part.skinned) continue;
        const auto n = static_cast<std::size_t>(part.node);
        const bool shown = after[n].parent >= 0 || !(after[n].world == before[n].world);
        // The same numbers as the document's, so that the node counts as unchanged.
        if (shown && part.transform == by * before[n].world) part.transform = after[n].world;
    }
    if (growth != 1) undo_growth(document, growth);
}

} // namespace

bool move_cameras_and_lights(Scene& scene, const std::vector<bool>& moved, const Transform& by) {
    if (by.identity()) return true;
    bool complete = true;
    for (std::size_t d = 0; d < scene.documents.size(); ++d) {
        const int number = static_cast<int>(d);
        bool all = true, any = false;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            if (scene.parts[i].document != number) continue;
            all = all && moved[i];
            any = true;
        }
        Json json = parse_document(scene.documents[d]->json);
        if (!all || count_of(json, "nodes") == 0) continue;
        const double growth = length_growth(by);
        if (growth != 1) scale_numbers(json, growth);
        complete = complete && (growth == 1 || !animates_numbers(json));
        // Skins move with their parts, which differ from the document until they are written.
        if (!any || (count_of(json, "skins") == 0 && !animated_nodes(json).empty()))
            move_all(scene, number, json, by, growth);
        else
            move_nodes(json, by, growth);
        auto document = std::make_shared<Document>(*scene.documents[d]);
        document->json = to_string(json);
        scene.documents[d] = std::move(document);
    }
    return complete;
}

} // namespace facetmill::io

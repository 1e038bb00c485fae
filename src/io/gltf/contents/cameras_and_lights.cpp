// Cameras and lights move along with a scene that moves as a whole.

#include "base/math/numbers.hpp"
#include "io/gltf/document/nodes.hpp"
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

void set_matrix(Json& node, const Transform& local) {
    for (const char* key : {"translation", "rotation", "scale", "matrix"}) node.erase(key);
    if (!local.identity()) node["matrix"] = matrix(local);
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
    set_matrix(document["nodes"][above], local);
}

/// Moves the nodes of cameras and lights without a mesh. All other nodes keep their places in the world.
void move_nodes(Json& document, const Transform& by, double growth) {
    const auto frames = node_frames(document);
    const auto animated = animated_nodes(document);
    std::vector<Transform> wanted;
    wanted.reserve(frames.size());
    for (const NodeFrame& frame : frames) wanted.push_back(frame.world);
    for (const std::size_t n : parents_first(frames)) {
        if (frames[n].mesh < 0 && has_camera_or_light(document["nodes"][n])) {
            wanted[n] = by * frames[n].world;
            for (auto& row : wanted[n].m)
                for (std::size_t c = 0; c < 3; ++c) row[c] /= growth;
        }
        const auto parent = static_cast<std::size_t>(frames[n].parent);
        const bool below = frames[n].parent >= 0;
        if (wanted[n] == frames[n].world && (!below || wanted[parent] == frames[parent].world)) continue;
        const auto up = below ? inverse(wanted[parent]) : Transform{};
        const auto down = animated.contains(n) ? inverse(frames[n].local) : Transform{};
        if (!up || !down) continue;
        if (animated.contains(n))
            put_above(document, n, *up * wanted[n] * *down);
        else
            set_matrix(document["nodes"][n], *up * wanted[n]);
    }
}

} // namespace

void move_cameras_and_lights(Scene& scene, const std::vector<bool>& moved, const Transform& by) {
    if (by.identity()) return;
    for (std::size_t d = 0; d < scene.documents.size(); ++d) {
        const std::string& text = scene.documents[d]->json;
        if (text.find("\"cameras\"") == std::string::npos && text.find(lights_extension) == std::string::npos)
            continue;
        bool all = true;
        for (std::size_t i = 0; i < moved.size(); ++i)
            all = all && (moved[i] || scene.parts[i].document != static_cast<int>(d));
        Json json = parse_document(text);
        if (!all || uses_extension(json, "KHR_animation_pointer")) continue; // which may drive their numbers
        const double growth = length_growth(by);
        if (growth != 1) scale_numbers(json, growth);
        move_nodes(json, by, growth);
        auto document = std::make_shared<Document>(*scene.documents[d]);
        document->json = to_string(json);
        scene.documents[d] = std::move(document);
    }
}

} // namespace facetmill::io

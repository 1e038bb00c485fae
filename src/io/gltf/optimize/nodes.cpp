// Moves nodes of a document to the top of their scene, and replaces many nodes by an instanced node.

#include "io/gltf/document/nodes.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"
#include "io/gltf/read/instances.hpp"
#include "mesh/transform.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace facetmill::io {

using namespace gltf;

namespace {

/// A transform as EXT_mesh_gpu_instancing stores it.
struct Stance {
    Vec3 translation, scale;
    std::array<double, 4> rotation; ///< x, y, z, w
};

/// The unit quaternion of a rotation matrix, given by its columns. After S. W. Shepperd, "Quaternion from
/// Rotation Matrix" (1978).
std::array<double, 4> quaternion_of(const Vec3& x, const Vec3& y, const Vec3& z) {
    const double squares[4] = {1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z,
                               1 + x.x + y.y + z.z};
    const std::size_t most = static_cast<std::size_t>(std::max_element(squares, squares + 4) - squares);
    const double s = std::sqrt(squares[most]) * 2; // four times the largest component
    const std::array<std::array<double, 4>, 4> all = {
        {{s / 4, (x.y + y.x) / s, (z.x + x.z) / s, (y.z - z.y) / s},
         {(x.y + y.x) / s, s / 4, (y.z + z.y) / s, (z.x - x.z) / s},
         {(z.x + x.z) / s, (y.z + z.y) / s, s / 4, (x.y - y.x) / s},
         {(y.z - z.y) / s, (z.x - x.z) / s, (x.y - y.x) / s, s / 4}}};
    return all[most];
}

/// None for a transform that shears, flattens or mirrors. Renderers flip the faces of mirrored nodes, but
/// not of mirrored instances.
std::optional<Stance> stance_of(const Transform& t) {
    constexpr double tolerable = 1e-6; // largest cosine of the angle between two axes
    Vec3 axes[3] = {t.vector({1, 0, 0}), t.vector({0, 1, 0}), t.vector({0, 0, 1})};
    Stance stance{t.point({0, 0, 0}), {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
        stance.scale[i] = length(axes[i]);
        if (!(stance.scale[i] > 0) || !std::isfinite(stance.scale[i])) return {};
        axes[i] = axes[i] / stance.scale[i];
    }
    for (std::size_t i = 0; i < 3; ++i)
        if (std::abs(dot(axes[i], axes[(i + 1) % 3])) > tolerable) return {};
    if (dot(cross(axes[0], axes[1]), axes[2]) < 0) return {};
    stance.rotation = quaternion_of(axes[0], axes[1], axes[2]);
    return stance;
}

} // namespace

std::size_t DocumentOptimizer::add(const char* list, Json item) {
    Json& all = json_[list];
    if (!all.is_array()) all = Json::array();
    all.push_back(std::move(item));
    return all.size() - 1;
}

std::size_t DocumentOptimizer::add_view(Bytes bytes) {
    const std::size_t buffer = add("buffers", {{"byteLength", bytes.size()}});
    const std::size_t view = add("bufferViews", {{"buffer", buffer}, {"byteLength", bytes.size()}});
    added_.push_back(std::move(bytes));
    return view;
}

std::size_t DocumentOptimizer::add_floats(const std::vector<float>& numbers, int components) {
    Bytes bytes(numbers.size() * sizeof(float));
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return add("accessors", {{"bufferView", add_view(std::move(bytes))},
                             {"componentType", int(float32)},
                             {"count", numbers.size() / static_cast<std::size_t>(components)},
                             {"type", components == 3 ? "VEC3" : "VEC4"}});
}

/// Adds the node to the scene that contains `like` or its root.
void DocumentOptimizer::put_at_top(std::size_t node, std::size_t like) {
    const auto frames = node_frames(json_);
    while (frames[like].parent >= 0) like = static_cast<std::size_t>(frames[like].parent);
    for (std::size_t s = 0; s < count_of(json_, "scenes"); ++s) {
        Json& nodes = json_["scenes"][s]["nodes"];
        if (std::find(nodes.begin(), nodes.end(), Json(like)) != nodes.end()) {
            nodes.push_back(node);
            return;
        }
    }
}

std::size_t DocumentOptimizer::flatten(const std::set<std::size_t>& nodes, std::set<std::size_t>& emptied) {
    const auto frames = node_frames(json_);
    std::size_t moved = 0;
    for (const std::size_t n : nodes) {
        if (frames[n].parent < 0) continue;
        ++moved;
        put_at_top(n, n);
        Json& parent = json_["nodes"][static_cast<std::size_t>(frames[n].parent)];
        Json& children = parent["children"];
        children.erase(std::find(children.begin(), children.end(), Json(n)));
        if (children.empty()) parent.erase("children");
        if (!parent.contains("mesh")) emptied.insert(static_cast<std::size_t>(frames[n].parent));
        Json& node = json_["nodes"][n];
        for (const char* key : {"translation", "rotation", "scale", "matrix"}) node.erase(key);
        if (!frames[n].world.identity()) node["matrix"] = matrix(frames[n].world);
    }
    return moved;
}

std::optional<DocumentOptimizer::NodeTransform>
DocumentOptimizer::instance(const std::vector<NodeTransform>& nodes) {
    std::vector<float> translations, rotations, scales;
    const Vec3 origin = nodes.front().second.point({0, 0, 0});
    bool turned = false, scaled = false;
    for (const auto& [_, where] : nodes) {
        const auto stance = stance_of(where);
        if (!stance) return {};
        const Vec3 from_origin = stance->translation - origin;
        for (std::size_t c = 0; c < 3; ++c) {
            translations.push_back(static_cast<float>(from_origin[c]));
            scales.push_back(static_cast<float>(stance->scale[c]));
            scaled |= scales.back() != 1;
        }
        for (const double r : stance->rotation) rotations.push_back(static_cast<float>(r));
        turned |= rotations.back() != 1;
    }
    Json attributes = {{"TRANSLATION", add_floats(translations, 3)}};
    if (turned) attributes["ROTATION"] = add_floats(rotations, 4);
    if (scaled) attributes["SCALE"] = add_floats(scales, 3);
    const std::size_t first = nodes.front().first;
    Json node = {{"mesh", json_["nodes"][first]["mesh"]},
                 {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}};
    if (json_["nodes"][first].contains("name")) node["name"] = json_["nodes"][first]["name"];
    Instances all;
    all.count = nodes.size();
    const auto numbers = [](int components, const std::vector<float>& told) {
        return Attribute{"", Domain::wedge, Role::generic, components, false, told};
    };
    all.translation = numbers(3, translations);
    if (turned) all.rotation = numbers(4, rotations);
    if (scaled) all.scale = numbers(3, scales);
    Transform place;
    for (std::size_t c = 0; c < 3; ++c) place.m[c][3] = origin[c];
    if (!place.identity()) node["translation"] = {origin.x, origin.y, origin.z};
    const std::size_t added = add("nodes", std::move(node));
    put_at_top(added, first);
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        add_name(json_, list, "EXT_mesh_gpu_instancing");
    return std::pair(added, place * all.largest_place());
}

} // namespace facetmill::io

#include "io/gltf/document/nodes.hpp"

#include "base/fast_json.hpp"
#include "base/text/unique_names.hpp"
#include "io/gltf/gltf.hpp"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <set>

namespace facetmill::io::gltf {

namespace {

template <std::size_t N>
std::array<double, N> numbers(const JsonCursor& node, const char* key, std::array<double, N> otherwise) {
    const auto found = node.find(key);
    if (!found) return otherwise;
    if (found->size() != N) found->fail(fmt::format("expected {} numbers, found {}", N, found->size()));
    std::array<double, N> values{};
    for (std::size_t i = 0; i < N; ++i) values[i] = found->at(i).real();
    return values;
}

Transform from_matrix(const JsonCursor& node) {
    const auto m = numbers<16>(node, "matrix", {});
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
        node.at("matrix").fail("the last row of the matrix is not 0, 0, 0, 1");
    Transform t;
    for (std::size_t row = 0; row < 3; ++row)
        for (std::size_t column = 0; column < 4; ++column) t.m[row][column] = m[column * 4 + row];
    return t;
}

double norm_of(const std::array<double, 4>& q) {
    return std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
}

Transform from_parts(const JsonCursor& node) {
    const auto move = numbers<3>(node, "translation", {0, 0, 0});
    const auto scale = numbers<3>(node, "scale", {1, 1, 1});
    const auto turn = numbers<4>(node, "rotation", {0, 0, 0, 1});
    if (!(norm_of(turn) > 0)) node.at("rotation").fail("the quaternion is zero");
    return transform_of({move[0], move[1], move[2]}, turn, {scale[0], scale[1], scale[2]});
}

/// A node must have one parent. If a file names two, the first applies, and `warn` is called.
void link_children(const JsonCursor& node, std::size_t index, std::vector<NodeFrame>& frames,
                   const Warn& warn) {
    const auto children = node.find("children");
    if (!children) return;
    for (std::size_t c = 0; c < children->size(); ++c) {
        const std::size_t child = children->at(c).index(frames.size(), "node");
        int& parent = frames[child].parent;
        if (parent >= 0 && warn)
            warn("W-NODES",
                 fmt::format("{}: node {} has two parents and is placed under the first, nodes[{}]",
                             children->at(c).path(), child, parent));
        if (parent < 0) parent = static_cast<int>(index);
    }
}

/// A level of detail (MSFT_lod) replaces the node that names it, so it has the same parent.
void link_levels(const JsonCursor& node, std::size_t index, std::vector<NodeFrame>& frames) {
    const auto extensions = node.find("extensions");
    const auto levels = extensions ? extensions->find("MSFT_lod") : std::nullopt;
    if (!levels) return;
    const JsonCursor ids = levels->at("ids");
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::size_t level = ids.at(i).index(frames.size(), "node");
        if (frames[level].parent < 0 && level != index) frames[level].parent = frames[index].parent;
    }
}

} // namespace

Transform transform_of(const Vec3& move, const std::array<double, 4>& turn, const Vec3& scale) {
    auto [x, y, z, w] = turn;
    const double norm = norm_of(turn);
    if (norm > 0) {
        x /= norm;
        y /= norm;
        z /= norm;
        w /= norm;
    }
    const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    Transform t;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) t.m[i][j] = r[i][j] * scale[j];
        t.m[i][3] = move[i];
    }
    return t;
}

Transform local_transform(const JsonCursor& node) {
    return node.find("matrix") ? from_matrix(node) : from_parts(node);
}

std::vector<NodeFrame> node_frames(const Json& document, const Warn& warn) {
    std::vector<NodeFrame> frames(count_of(document, "nodes"));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const JsonCursor node = item(document, "nodes", i);
        frames[i].local = local_transform(node);
        if (const auto mesh = node.find("mesh"))
            frames[i].mesh = static_cast<int>(mesh->index(count_of(document, "meshes"), "mesh"));
        if (const auto skin = node.find("skin")) {
            skin->index(count_of(document, "skins"), "skin");
            frames[i].skinned = frames[i].mesh >= 0;
        }
        link_children(node, i, frames, warn);
    }
    for (std::size_t i = 0; i < frames.size(); ++i) link_levels(item(document, "nodes", i), i, frames);
    for (const std::size_t i : parents_first(frames)) {
        const int parent = frames[i].parent;
        frames[i].world =
            parent < 0 ? frames[i].local : frames[static_cast<std::size_t>(parent)].world * frames[i].local;
    }
    return frames;
}

bool drop_further_parents(Json& document, const std::vector<NodeFrame>& frames) {
    bool dropped = false;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const auto children = document["nodes"][n].find("children");
        if (children == document["nodes"][n].end() || !children->is_array()) continue;
        std::set<std::size_t> own;
        Json kept = Json::array();
        for (const Json& child : *children)
            if (const auto c = child.get<std::size_t>();
                c < frames.size() && frames[c].parent == static_cast<int>(n) && own.insert(c).second)
                kept.push_back(child);
        if (kept.size() == children->size()) continue;
        dropped = true;
        if (kept.empty())
            document["nodes"][n].erase("children");
        else
            *children = std::move(kept);
    }
    return dropped;
}

std::vector<bool> shown_nodes(const Json& document) {
    const std::size_t count = count_of(document, "nodes"), scenes = count_of(document, "scenes");
    std::vector<bool> shown(count, scenes == 0);
    if (scenes == 0) return shown;
    const auto number = [](const Json& n, std::size_t below) -> std::optional<std::size_t> {
        const bool is_one = n.is_number_unsigned() && n.get<std::uint64_t>() < below;
        return is_one ? std::optional(n.get<std::size_t>()) : std::nullopt;
    };
    std::vector<std::size_t> waiting;
    const auto visit = [&](const Json& of, const char* key) {
        const auto list = of.find(key);
        if (list == of.end() || !list->is_array()) return;
        for (const Json& item : *list)
            if (const auto n = number(item, count); n && !shown[*n]) {
                shown[*n] = true;
                waiting.push_back(*n);
            }
    };
    const auto scene = document.find("scene");
    visit(document["scenes"][scene == document.end() ? 0 : number(*scene, scenes).value_or(0)], "nodes");
    while (!waiting.empty()) {
        const Json& node = document["nodes"][waiting.back()];
        waiting.pop_back();
        visit(node, "children");
        const auto extensions = node.find("extensions");
        if (extensions == node.end()) continue;
        if (const auto levels = extensions->find("MSFT_lod"); levels != extensions->end())
            visit(*levels, "ids");
    }
    return shown;
}

std::string animation_pointer(const JsonCursor& channel) {
    const auto extensions = channel.at("target").find("extensions");
    const auto pointer = extensions ? extensions->find("KHR_animation_pointer") : std::nullopt;
    return pointer ? pointer->text_or("pointer", "") : "";
}

std::optional<AnimatedProperty> animated_property(const JsonCursor& channel, std::size_t nodes) {
    const JsonCursor target = channel.at("target");
    if (target.find("node")) {
        const std::size_t node = target.at("node").index(nodes, "node");
        return AnimatedProperty{node, target.text_or("path", "")};
    }
    const std::string text = animation_pointer(channel);
    constexpr std::string_view start = "/nodes/";
    std::size_t node = 0;
    if (!text.starts_with(start)) return {};
    const auto [at, error] = std::from_chars(text.data() + start.size(), text.data() + text.size(), node);
    if (error != std::errc() || *at != '/' || node >= nodes) return {};
    return AnimatedProperty{node, std::string(at + 1)};
}

std::set<std::size_t> animated_nodes(const Json& document) {
    std::set<std::size_t> nodes;
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor channels = item(document, "animations", a).at("channels");
        for (std::size_t c = 0; c < channels.size(); ++c)
            if (const auto property = animated_property(channels.at(c), count_of(document, "nodes")))
                for (const char* path : {"translation", "rotation", "scale"})
                    if (property->path == path) nodes.insert(property->node);
    }
    return nodes;
}

std::vector<std::size_t> parents_first(const std::vector<NodeFrame>& frames) {
    std::vector<std::vector<std::size_t>> children(frames.size());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (frames[i].parent < 0)
            order.push_back(i);
        else
            children[static_cast<std::size_t>(frames[i].parent)].push_back(i);
    }
    for (std::size_t done = 0; done < order.size(); ++done)
        for (const std::size_t child : children[order[done]]) order.push_back(child);
    // Every node has at most one parent, so nodes that no root reaches form a cycle.
    if (order.size() < frames.size()) {
        const std::set<std::size_t> reached(order.begin(), order.end());
        for (std::size_t i = 0; i < frames.size(); ++i)
            if (!reached.count(i))
                throw Error(ErrorKind::malformed, "E-NODES",
                            fmt::format("nodes[{}]: the node is its own ancestor", i));
    }
    return order;
}

Drawn kind_of(const JsonCursor& primitive) {
    const auto mode = primitive.natural_or("mode", 4);
    if (mode > 6) primitive.at("mode").fail(fmt::format("{} is not a mode", mode));
    if (!primitive.at("attributes").find("POSITION")) return Drawn::none; // an extension may provide them
    return mode >= 4 ? Drawn::triangles : mode >= 1 ? Drawn::lines : Drawn::points;
}

Drawn kind_of_mesh(const JsonCursor& mesh) {
    Drawn kind = Drawn::none;
    const JsonCursor primitives = mesh.at("primitives");
    for (std::size_t i = 0; i < primitives.size() && kind != Drawn::triangles; ++i)
        kind = std::max(kind, kind_of(primitives.at(i)));
    return kind;
}

bool makes_triangles(const JsonCursor& primitive) { return kind_of(primitive) == Drawn::triangles; }

bool has_triangles(const JsonCursor& mesh) { return kind_of_mesh(mesh) == Drawn::triangles; }

std::vector<Placement> placements(const Json& document, const std::vector<NodeFrame>& frames) {
    std::vector<Placement> all;
    UniqueNames names;
    std::vector<char> read(count_of(document, "meshes"));
    for (std::size_t m = 0; m < read.size(); ++m) {
        const JsonCursor mesh = item(document, "meshes", m);
        read[m] = kind_of_mesh(mesh) != Drawn::none;
    }
    const auto place = [&](int node, int mesh, bool skinned, const Transform& world) {
        if (!read[static_cast<std::size_t>(mesh)]) return;
        std::string name =
            node < 0 ? "" : item(document, "nodes", static_cast<std::size_t>(node)).text_or("name", "");
        if (name.empty()) name = item(document, "meshes", static_cast<std::size_t>(mesh)).text_or("name", "");
        if (name.empty()) name = fmt::format("mesh_{}", mesh);
        all.push_back({names.add(name), node, mesh, skinned, skinned ? Transform{} : world, 0, {}});
    };
    for (std::size_t i = 0; i < frames.size(); ++i)
        if (frames[i].mesh >= 0)
            place(static_cast<int>(i), frames[i].mesh, frames[i].skinned, frames[i].world);
    if (frames.empty())
        for (std::size_t m = 0; m < read.size(); ++m) place(-1, static_cast<int>(m), false, {});
    return all;
}

BaseDocument base_document(const Scene& scene) {
    for (std::size_t d = 0; d < scene.documents.size(); ++d) {
        Json json = parse_document(scene.documents[d]->json);
        for (const char* content : {"scenes", "nodes", "meshes"})
            if (json.contains(content)) return {static_cast<int>(d), std::move(json)};
    }
    // Without parts, a library of images or materials is all there is to write.
    if (scene.parts.empty() && !scene.documents.empty()) return {0, parse_document(scene.documents[0]->json)};
    return {};
}

Json matrix(const Transform& t) {
    Json out = Json::array();
    for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 3; ++row) out.push_back(t.m[row][column]);
        out.push_back(column == 3 ? 1.0 : 0.0);
    }
    return out;
}

} // namespace facetmill::io::gltf

namespace facetmill::io {

bool is_without_meshes(const Scene& scene) {
    if (!scene.parts.empty() || scene.documents.empty()) return false;
    return std::all_of(scene.documents.begin(), scene.documents.end(), [](const auto& document) {
        Json json = gltf::parse_document(document->json);
        const ScopedDestroy after(json);
        return gltf::placements(json, gltf::node_frames(json)).empty();
    });
}

} // namespace facetmill::io

#include "io/gltf/read/lines.hpp"

#include "base/math/numbers.hpp"
#include "io/gltf/read/instances.hpp"

#include <fmt/format.h>
#include <map>
#include <optional>
#include <string_view>

namespace facetmill::io::gltf {

namespace {

constexpr const char* suffix_of_lines = "_lines";

/// Appends the lines of a primitive in world space.
void add_lines(Source& source, const JsonCursor& primitive, const Transform& world, std::size_t max_vertices,
               Lines& lines) {
    const Accessor positions = accessor(source, primitive.at("attributes").at("POSITION"));
    if (positions.components != 3) positions.place.fail("POSITION must be VEC3");
    if (positions.count > max_vertices - std::min(max_vertices, lines.points.size()))
        throw Error(ErrorKind::limit, "E-LIMIT",
                    fmt::format("{}: more than {} vertices", primitive.path(), max_vertices));
    const Attribute values{"POSITION", Domain::vertex,       Role::generic,
                           3,          positions.normalised, decode(source, positions)};
    std::vector<Index> order;
    if (const auto reference = primitive.find("indices"))
        order = decode_indices(source, *reference, positions.count);
    else
        for (Index i = 0; i < positions.count; ++i) order.push_back(i);
    Index material = none;
    if (const auto place = primitive.find("material"))
        material = static_cast<Index>(place->index(count_of(source.json(), "materials"), "material"));
    source.need(static_cast<double>(sizeof(Vec3) * positions.count + sizeof(Lines::Segment) * order.size()));
    const std::vector<Index> ends = ends_of_lines(order, primitive.natural_or("mode", 4));
    const auto base = static_cast<Index>(lines.points.size());
    for (std::size_t i = 0; i < positions.count; ++i) {
        const Vec3 p = world.point({values.value(i, 0), values.value(i, 1), values.value(i, 2)});
        if (!is_finite(p)) positions.place.fail(fmt::format("point {} of a line is not finite", i), "E-NAN");
        lines.points.push_back(p);
    }
    for (std::size_t i = 0; i < ends.size(); i += 2)
        lines.segments.push_back({base + ends[i], base + ends[i + 1], material});
}

/// Removes the lines from a mesh that also has triangles, and returns them as a mesh.
Json lines_taken_from(Json& mesh, const std::string& path) {
    const JsonCursor before(mesh, path);
    Json kept = Json::array(), lines = Json::array();
    const JsonCursor primitives = before.at("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i)
        (makes_lines(primitives.at(i)) ? lines : kept).push_back(primitives.at(i).json());
    Json taken = Json::object();
    const std::string name = before.text_or("name", "");
    if (!name.empty()) taken["name"] = name + suffix_of_lines;
    taken["primitives"] = std::move(lines);
    if (mesh.contains("weights")) taken["weights"] = mesh["weights"];
    if (const auto extras = before.find("extras"); extras && extras->json().is_object())
        if (const auto names = extras->find("targetNames")) taken["extras"]["targetNames"] = names->json();
    mesh["primitives"] = std::move(kept);
    return taken;
}

/// A node with the same transform but another mesh.
Json beside_node(const Json& node, std::size_t mesh, const std::string& path) {
    Json beside = Json::object();
    const std::string name = JsonCursor(node, path).text_or("name", "");
    if (!name.empty()) beside["name"] = name + suffix_of_lines;
    beside["mesh"] = mesh;
    for (const char* key : {"skin", "weights"})
        if (node.contains(key)) beside[key] = node[key];
    if (const auto extensions = JsonCursor(node, path).find("extensions"))
        if (const auto instances = extensions->find(instancing_extension))
            beside["extensions"][instancing_extension] = instances->json();
    return beside;
}

/// True if the mesh has triangles and lines.
bool has_both(const JsonCursor& mesh) {
    if (!has_triangles(mesh)) return false;
    const JsonCursor primitives = mesh.at("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i)
        if (makes_lines(primitives.at(i))) return true;
    return false;
}

/// The nodes and meshes that were split off, by their originals.
struct Beside {
    std::map<std::size_t, std::size_t> nodes, meshes;
};

std::optional<std::size_t> known(const std::map<std::size_t, std::size_t>& beside, std::size_t number) {
    const auto found = beside.find(number);
    return found == beside.end() ? std::nullopt : std::optional(found->second);
}

/// Converts a pointer to morph weights (KHR_animation_pointer) into the pointer to the weights of the
/// split-off node or mesh; none for other pointers.
std::optional<std::string> pointer_beside(const std::string& pointer, const Beside& beside) {
    constexpr std::string_view end = "/weights";
    const std::string_view text = pointer;
    for (const auto& [list, numbers] :
         {std::pair{std::string_view("/nodes/"), &beside.nodes}, {"/meshes/", &beside.meshes}}) {
        if (text.size() < list.size() + end.size() || !text.starts_with(list) || !text.ends_with(end))
            continue;
        const auto number = parse_integer(text.substr(list.size(), text.size() - list.size() - end.size()));
        const auto other = number ? known(*numbers, static_cast<std::size_t>(*number)) : std::nullopt;
        if (other) return fmt::format("{}{}{}", list, *other, end);
    }
    return {};
}

/// The target of a channel for the morph weights of the split-off node, or null.
Json target_beside(const JsonCursor& target, const Beside& beside, std::size_t nodes) {
    Json moved = target.json();
    if (const auto node = target.find("node"); node && target.text_or("path", "") == "weights") {
        const auto other = known(beside.nodes, node->index(nodes, "node"));
        if (!other) return nullptr;
        moved["node"] = *other;
        return moved;
    }
    constexpr const char* extension = "KHR_animation_pointer";
    const auto extensions = target.find("extensions");
    const auto pointed = extensions ? extensions->find(extension) : std::nullopt;
    if (!pointed) return nullptr;
    const auto pointer = pointer_beside(pointed->text_or("pointer", ""), beside);
    if (!pointer) return nullptr;
    moved["extensions"][extension]["pointer"] = *pointer;
    return moved;
}

/// Copies animations of a node's morph weights to its split-off node.
void animate_beside(Json& document, const Beside& beside, std::size_t nodes) {
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor channels = item(document, "animations", a).at("channels");
        Json more = Json::array();
        for (std::size_t c = 0; c < channels.size(); ++c) {
            Json target = target_beside(channels.at(c).at("target"), beside, nodes);
            if (target.is_null()) continue;
            more.push_back(channels.at(c).json());
            more.back()["target"] = std::move(target);
        }
        for (Json& channel : more) document["animations"][a]["channels"].push_back(std::move(channel));
    }
}

/// Throws a malformed-input error when a scene refers to a missing node.
void check_roots(const Json& document, std::size_t nodes) {
    for (std::size_t s = 0; s < count_of(document, "scenes"); ++s)
        if (const auto roots = item(document, "scenes", s).find("nodes"))
            for (std::size_t i = 0; i < roots->size(); ++i) roots->at(i).index(nodes, "node");
}

} // namespace

bool part_lines(Json& document) {
    std::vector<std::size_t> both;
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m)
        if (has_both(item(document, "meshes", m))) both.push_back(m);
    if (both.empty()) return false;
    const auto frames =
        node_frames(document); // before adding meshes and nodes, so that nothing refers to them yet
    check_roots(document, frames.size());
    Beside beside;
    for (const std::size_t m : both) {
        const std::string path = item(document, "meshes", m).path();
        Json lines = lines_taken_from(document["meshes"][m], path);
        beside.meshes[m] = document["meshes"].size();
        document["meshes"].push_back(std::move(lines));
    }
    for (std::size_t n = 0; n < frames.size(); ++n) {
        if (frames[n].mesh < 0) continue;
        const auto lines = known(beside.meshes, static_cast<std::size_t>(frames[n].mesh));
        if (!lines) continue;
        Json node = beside_node(document["nodes"][n], *lines, item(document, "nodes", n).path());
        beside.nodes[n] = document["nodes"].size();
        document["nodes"][n]["children"].push_back(beside.nodes[n]);
        document["nodes"].push_back(std::move(node));
    }
    animate_beside(document, beside, frames.size());
    return true;
}

std::vector<Index> ends_of_lines(const std::vector<Index>& indices, std::uint64_t mode) {
    enum Mode : std::uint64_t { list = 1, loop = 2 };
    std::vector<Index> ends;
    for (std::size_t i = 0; i + 1 < indices.size(); i += mode == list ? 2 : 1)
        ends.insert(ends.end(), {indices[i], indices[i + 1]});
    if (mode == loop && indices.size() > 1) ends.insert(ends.end(), {indices.back(), indices.front()});
    return ends;
}

std::vector<Lines> decode_lines(Source& source, const std::vector<NodeFrame>& frames,
                                std::size_t max_vertices) {
    std::vector<Lines> all;
    std::size_t left = std::min<std::size_t>(max_vertices, none - 1);
    for (std::size_t n = 0; n < frames.size(); ++n) {
        if (frames[n].mesh < 0) continue;
        const JsonCursor mesh = item(source.json(), "meshes", static_cast<std::size_t>(frames[n].mesh));
        if (!has_triangles(mesh)) continue;
        const JsonCursor primitives = mesh.at("primitives");
        Lines lines;
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (makes_lines(primitives.at(i)))
                add_lines(source, primitives.at(i), frames[n].world, left, lines);
        if (lines.segments.empty()) continue;
        lines.name = item(source.json(), "nodes", n).text_or("name", mesh.text_or("name", ""));
        left -= lines.points.size();
        all.push_back(std::move(lines));
    }
    return all;
}

} // namespace facetmill::io::gltf

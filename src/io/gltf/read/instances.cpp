#include "io/gltf/read/instances.hpp"

#include "base/function.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/transform.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace facetmill::io::gltf {

namespace {

/// An attribute of the instances: its name in the extension and its name in a node.
struct PlaceAttribute {
    const char* semantic;
    const char* member;
    int components;
    std::optional<Attribute> Instances::*numbers;
};

constexpr PlaceAttribute place_attributes[] = {{"TRANSLATION", "translation", 3, &Instances::translation},
                                               {"ROTATION", "rotation", 4, &Instances::rotation},
                                               {"SCALE", "scale", 3, &Instances::scale}};

Instances read_instances(Source& source, const JsonCursor& attributes) {
    Instances all;
    bool first = true;
    for (const auto& [name, reference] : attributes.json().items()) {
        const Accessor a = accessor(source, JsonCursor(reference, attributes.path() + "." + name));
        if (!first && a.count != all.count)
            attributes.fail("the attributes of instances have different counts");
        all.count = a.count;
        first = false;
        const auto known =
            std::find_if(std::begin(place_attributes), std::end(place_attributes),
                         [&, &semantic = name](const PlaceAttribute& p) { return semantic == p.semantic; });
        if (known == std::end(place_attributes)) {
            all.others.push_back(name);
            continue;
        }
        if (a.components != known->components)
            attributes.fail(fmt::format("{} must have {} numbers", name, known->components));
        all.*known->numbers = decode_numbers(source, a);
    }
    return all;
}

Vec3 three(const std::optional<Attribute>& a, std::size_t i, const Vec3& otherwise) {
    return a ? Vec3{a->value(i, 0), a->value(i, 1), a->value(i, 2)} : otherwise;
}

Json node_of(const Instances& all, std::size_t i, const Json& mesh, const std::string& name) {
    Json node = {{"mesh", mesh}};
    if (!name.empty()) node["name"] = name;
    for (const PlaceAttribute& p : place_attributes) {
        const auto& told = all.*p.numbers;
        Json numbers = Json::array();
        for (int c = 0; told && c < p.components; ++c) numbers.push_back(told->value(i, c));
        if (told) node[p.member] = std::move(numbers);
    }
    return node;
}

} // namespace

Transform Instances::place(std::size_t i) const {
    std::array<double, 4> turn{0, 0, 0, 1};
    for (int c = 0; rotation && c < 4; ++c) turn[static_cast<std::size_t>(c)] = rotation->value(i, c);
    return transform_of(three(translation, i, {}), turn, three(scale, i, {1, 1, 1}));
}

Transform Instances::largest_place() const {
    Transform largest;
    double most = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 s = three(scale, i, {1, 1, 1});
        const double size = std::max({std::abs(s.x), std::abs(s.y), std::abs(s.z)});
        if (!(size > most)) continue;
        const Transform t = place(i);
        if (!inverse(t) || !is_finite(t.point({}))) continue;
        largest = t;
        most = size;
    }
    return largest;
}

std::optional<Instances> instances_of(Source& source, std::size_t index) {
    const JsonCursor node = item(source.json(), "nodes", index);
    const auto extensions = node.find("extensions");
    const auto extension = extensions ? extensions->find(instancing_extension) : std::nullopt;
    const auto attributes = extension ? extension->find("attributes") : std::nullopt;
    if (!attributes || !node.find("mesh") || node.find("skin")) return {};
    if (!attributes->json().is_object()) attributes->fail("expected an object");
    if (attributes->json().empty()) return {};
    return read_instances(source, *attributes);
}

void stand_at_largest_instances(Source& source, const std::vector<NodeFrame>& frames,
                                std::vector<Placement>& placements) {
    if (!uses_extension(source.json(), instancing_extension)) return;
    for (Placement& placement : placements) {
        if (placement.node < 0) continue;
        const auto node = static_cast<std::size_t>(placement.node);
        const auto all = instances_of(source, node);
        if (!all) continue;
        placement.instances = all->count;
        placement.largest_instance = all->largest_place();
        placement.world = frames[node].world * placement.largest_instance;
    }
}

std::optional<Attribute> translations_on_grid(const Instances& given, const PositionGrid& grid) {
    std::vector<float> translations;
    for (std::size_t i = 0; i < given.count; ++i) {
        const Vec3 steps = given.place(i).point(grid.origin) / grid.step;
        for (std::size_t c = 0; c < 3; ++c) {
            if (!(std::abs(steps[c]) <= double{std::numeric_limits<float>::max()})) return {};
            translations.push_back(static_cast<float>(steps[c]));
        }
    }
    return Attribute{"", Domain::wedge, Role::generic, 3, false, std::move(translations)};
}

void expand_instances(Json& document, const std::vector<Bytes>& buffers, ReadLog& log) {
    constexpr double bytes_of_node = 2000; // memory of a node, including its part
    const Json original = document;
    Source source(original, buffers);
    double needed = 0;
    const std::size_t nodes = count_of(original, "nodes");
    std::vector<std::string> others;
    for (std::size_t n = 0; n < nodes; ++n) {
        const auto all = instances_of(source, n);
        if (!all) continue;
        for (const std::string& name : all->others)
            if (std::find(others.begin(), others.end(), name) == others.end()) others.push_back(name);
        needed += bytes_of_node * static_cast<double>(all->count);
        require_memory(needed, "making nodes of instances", "leave out instances: expand");
        const JsonCursor node = item(original, "nodes", n);
        Json& owner = document["nodes"][n];
        Json children = owner.contains("children") ? owner["children"] : Json::array();
        for (std::size_t i = 0; i < all->count; ++i) {
            children.push_back(document["nodes"].size());
            document["nodes"].push_back(node_of(*all, i, node.at("mesh").json(), node.text_or("name", "")));
        }
        Json& changed = document["nodes"][n]; // the list may have been reallocated
        if (!children.empty()) changed["children"] = std::move(children);
        changed.erase("mesh");
        changed["extensions"].erase(instancing_extension);
        if (changed["extensions"].erase(instance_features) > 0) others.emplace_back(instance_features);
        if (changed["extensions"].empty()) changed.erase("extensions");
    }
    const auto has = [](const Json& node) {
        return node.contains("extensions") && node["extensions"].contains(instancing_extension);
    };
    if (nodes == 0 || std::any_of(document["nodes"].begin(), document["nodes"].end(), has)) return;
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        remove_name(document, list, instancing_extension);
        remove_name(document, list, instance_features);
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

namespace facetmill::io {

namespace {

/// Calls visit for each part with instances: its number in the scene, the transform of the largest instance
/// relative to the node, and all instances.
void for_each_instanced(
    const Scene& scene,
    const Function<void(std::size_t part, const Transform& largest, const gltf::Instances& all)>& visit) {
    for (std::size_t d = 0; d < scene.documents.size(); ++d) {
        const Document& document = *scene.documents[d];
        if (document.json.find(gltf::instancing_extension) == std::string::npos) continue;
        const Json json = gltf::parse_document(document.json);
        gltf::Source source(json, document.buffers);
        std::map<int, gltf::Instances> known; // instances by node
        for (std::size_t i = 0; i < scene.parts.size(); ++i) {
            const Part& part = scene.parts[i];
            if (part.document != static_cast<int>(d) || part.node < 0) continue;
            auto found = known.find(part.node);
            if (found == known.end()) {
                auto all = gltf::instances_of(source, static_cast<std::size_t>(part.node));
                if (!all || all->count == 0) continue;
                found = known.emplace(part.node, *std::move(all)).first;
            }
            visit(i, found->second.largest_place(), found->second);
        }
    }
}

} // namespace

std::vector<double> errors_of_instances(const Scene& scene, bool filters) {
    constexpr double of_float = 1.0 / (1 << 23);
    // Each component of the quaternion has an error of 1.1e-5 when stored and 1.5e-5 when decoded. The error
    // of the largest component is up to sqrt(3) times as much. The total is an angle below this value.
    constexpr double of_rotation = 2e-4;
    std::vector<double> errors(scene.parts.size());
    for_each_instanced(scene, [&](std::size_t i, const Transform& at, const gltf::Instances&) {
        const Part& part = scene.parts[i];
        const Box box = part.mesh.bounds();
        if (box.empty()) return;
        const double corner = std::max(length(box.min), length(box.max)),
                     inside = length(at.point({})) + greatest_stretch(at) * corner, // relative to the node
            outside = greatest_stretch(part.transform) / greatest_stretch(at);
        errors[i] =
            2 * of_float * inside * outside +
            (filters ? of_rotation * std::max(box.diagonal(), corner) * greatest_stretch(part.transform) : 0);
    });
    return errors;
}

void for_each_place_of_instances(
    const Scene& scene, const Function<void(std::size_t part, const Transform& place, double times)>& visit) {
    constexpr std::size_t most = 65536;
    for_each_instanced(scene, [&](std::size_t i, const Transform& largest, const gltf::Instances& all) {
        const auto back = inverse(largest);
        if (!back) return; // cannot happen for a largest instance
        const Transform node = scene.parts[i].transform * *back;
        const std::size_t step = (all.count + most - 1) / most;
        for (std::size_t k = 0; k < all.count; k += step)
            visit(i, node * all.place(k), static_cast<double>(std::min(step, all.count - k)));
    });
}

} // namespace facetmill::io

#include "io/gltf/document/shorten.hpp"

#include "base/math/numbers.hpp"
#include "io/gltf/document/builder.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/document/roots.hpp"
#include "io/gltf/numbers/quantise.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace facetmill::io::gltf {

namespace {

/// Calls change for every floating-point number in json, except in extras.
template <class Change>
void each_real(Json& json, const Change& change) {
    if (json.is_number_float())
        change(json);
    else if (json.is_array())
        for (Json& value : json.get_ref<Json::array_t&>()) each_real(value, change);
    else if (json.is_object())
        for (auto& [key, value] : json.get_ref<Json::object_t&>())
            if (key != "extras") each_real(value, change);
}

void as_integer(Json& number) {
    constexpr double most = 1e15; // integers up to here are exact in doubles
    const double x = number.get<double>();
    if (std::abs(x) < most && x == std::floor(x)) number = static_cast<std::int64_t>(x);
}

/// Replaces the number by the shortest text that gives the same float32.
void as_single(Json& number) {
    const auto x = static_cast<float>(number.get<double>());
    if (std::isfinite(x)) number = parse_real(fmt::format("{}", x)).value_or(number.get<double>());
}

/// The number with the fewest decimals within this tolerance.
double within(double x, double tolerance) { return short_near(x, 100 * tolerance); }

/// True if the matrix has no rotation or shear.
bool is_straight(const Json& matrix) {
    for (std::size_t i = 0; i < 16; ++i) {
        const bool free = i >= 12 || i % 5 == 0;
        if (!free && matrix[i].get<double>() != 0) return false;
    }
    return true;
}

void split_matrix(Json& node) {
    if (!node.contains("matrix") || !is_straight(node["matrix"])) return;
    const Json matrix = node["matrix"];
    node.erase("matrix");
    node["translation"] = Json::array({matrix[12], matrix[13], matrix[14]});
    node["scale"] = Json::array({matrix[0], matrix[5], matrix[10]});
}

void erase_defaults(Json& node) {
    const auto is = [&](const char* key, const std::vector<double>& value) {
        return node.contains(key) && node[key].get<std::vector<double>>() == value;
    };
    if (is("translation", {0, 0, 0})) node.erase("translation");
    if (is("rotation", {0, 0, 0, 1})) node.erase("rotation");
    if (is("scale", {1, 1, 1})) node.erase("scale");
}

/// The allowed error of a node's numbers: a length for its translation, and a share of the largest number for
/// the others.
struct Tolerance {
    double length = 0, share = 0;
};

void round_place(Json& node, const Tolerance& tolerance) {
    const auto round = [](Json& numbers, std::size_t begin, std::size_t end, double by) {
        for (std::size_t i = begin; i < end; ++i) numbers[i] = within(numbers[i].get<double>(), by);
    };
    const auto round_shares = [&](Json& numbers, std::size_t end) {
        double most = 0;
        for (std::size_t i = 0; i < end; ++i) most = std::max(most, std::abs(numbers[i].get<double>()));
        round(numbers, 0, end, tolerance.share * most);
    };
    if (node.contains("translation")) round(node["translation"], 0, 3, tolerance.length);
    if (node.contains("scale")) round_shares(node["scale"], 3);
    if (node.contains("rotation")) round_shares(node["rotation"], 4);
    if (!node.contains("matrix")) return;
    round_shares(node["matrix"], 12);
    round(node["matrix"], 12, 15, tolerance.length);
}

/// Shortens nodes' numbers to the digits that matter in a scene of this size. Nodes far from their
/// coordinate origin need more digits.
void shorten_nodes(Json& document, const Box& bounds, const std::vector<Transform>& worlds) {
    if (!document.contains("nodes")) return;
    const auto frames = node_frames(document);
    const auto world = [&](std::size_t n) { return worlds.empty() ? frames[n].world : worlds[n]; };
    const double size = bounds.empty() ? 0 : bounds.diagonal();
    constexpr double ratio = 1e-8;            // times the diagonal: a thousandth of a step of 17 bits
    const auto stretch = [&](std::size_t n) { // scale of the translation's space
        return frames[n].parent < 0 ? 1.0
                                    : greatest_stretch(world(static_cast<std::size_t>(frames[n].parent)));
    };
    double reach = size;
    for (std::size_t n = 0; n < frames.size(); ++n)
        reach = std::max({reach, length(world(n).point({})), stretch(n) * length(frames[n].local.point({}))});
    const bool known = size > 0 && std::isfinite(reach);
    const bool pointers = uses_extension(document, "KHR_animation_pointer");
    const auto animated = animated_nodes(document);
    for (std::size_t n = 0; n < frames.size() && !pointers; ++n) {
        Json& node = document["nodes"][n];
        split_matrix(node);
        if (known) round_place(node, {ratio * size / stretch(n), ratio * size / reach});
        if (!animated.contains(n)) erase_defaults(node);
    }
}

/// Linear interpolation and zero morph weights are the defaults.
void erase_default_members(Json& document) {
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a)
        for (Json& sampler : document["animations"][a]["samplers"])
            if (sampler.value("interpolation", "") == "LINEAR") sampler.erase("interpolation");
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m) {
        Json& mesh = document["meshes"][m];
        if (!mesh.contains("weights")) continue;
        const auto weights = mesh["weights"].get<std::vector<double>>();
        if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; }))
            mesh.erase("weights");
    }
}

using Defaults = std::vector<std::pair<const char*, Json>>;

void erase_equal(Json& object, const Defaults& defaults) {
    for (const auto& [key, value] : defaults)
        if (const auto found = object.find(key); found != object.end() && *found == value) object.erase(key);
}

/// Erases default members of texture references ("...Texture") in a material and its extensions.
void erase_texture_defaults(Json& json) {
    static const Defaults reference{{"texCoord", 0}, {"scale", 1}, {"strength", 1}},
        placing{{"offset", Json::array({0, 0})}, {"rotation", 0}, {"scale", Json::array({1, 1})}};
    for (auto& [key, value] : json.get_ref<Json::object_t&>()) {
        if (key == "extras" || !value.is_object()) continue;
        if (std::string_view(key).ends_with("Texture") && value.contains("index")) {
            erase_equal(value, reference);
            const Json::json_pointer place("/extensions/KHR_texture_transform");
            if (value.contains(place) && value[place].is_object()) erase_equal(value[place], placing);
        }
        erase_texture_defaults(value);
    }
}

void erase_material_defaults(Json& document) {
    static const Defaults own{{"emissiveFactor", Json::array({0, 0, 0})},
                              {"alphaMode", "OPAQUE"},
                              {"alphaCutoff", 0.5},
                              {"doubleSided", false}},
        pbr{{"baseColorFactor", Json::array({1, 1, 1, 1})}, {"metallicFactor", 1}, {"roughnessFactor", 1}};
    for (std::size_t m = 0; m < count_of(document, "materials"); ++m) {
        Json& material = document["materials"][m];
        if (!material.is_object()) continue;
        erase_equal(material, own);
        erase_texture_defaults(material);
        const auto found = material.find("pbrMetallicRoughness");
        if (found == material.end() || !found->is_object()) continue;
        erase_equal(*found, pbr);
        if (found->empty()) material.erase("pbrMetallicRoughness");
    }
    for (std::size_t s = 0; s < count_of(document, "samplers"); ++s)
        if (document["samplers"][s].is_object())
            erase_equal(document["samplers"][s], {{"wrapS", 10497}, {"wrapT", 10497}});
    if (document.contains("extensions") && document["extensions"].empty()) document.erase("extensions");
}

void drop_zero_offsets(Json& document) {
    const auto drop = [](Json& object) {
        if (object.contains("byteOffset") && object["byteOffset"] == 0) object.erase("byteOffset");
    };
    for (const char* list : {"bufferViews", "accessors"})
        for (std::size_t i = 0; i < count_of(document, list); ++i) {
            Json& object = document[list][i];
            drop(object);
            if (object.contains("extensions"))
                for (auto& [name, extension] : object["extensions"].items())
                    if (name == meshopt_names[0] || name == meshopt_names[1]) drop(extension);
        }
}

} // namespace

void shorten(Json& document, const Box& bounds, const std::vector<Transform>& worlds) {
    shorten_nodes(document, bounds, worlds);
    if (!uses_extension(document, "KHR_animation_pointer")) erase_material_defaults(document);
    if (document.contains("materials")) each_real(document["materials"], as_single);
    drop_zero_offsets(document);
    erase_default_members(document);
    each_real(document, as_integer);
}

namespace {

/// Whether a node has only a name: applications find such a node by its name and attach objects to it.
bool is_named_place(const Json& node) {
    for (const auto& [key, value] : node.items())
        if (key != "name" && key != "translation" && key != "rotation" && key != "scale" && key != "matrix")
            return false;
    return true;
}

} // namespace

void drop_names(Json& document) {
    const std::set<std::size_t> joints = joint_nodes(document);
    for (const char* list : {"nodes", "meshes", "accessors", "bufferViews", "buffers", "images", "textures",
                             "samplers", "skins"})
        for (std::size_t i = 0; i < count_of(document, list); ++i)
            if (list != std::string_view("nodes") || joints.contains(i) || !is_named_place(document[list][i]))
                document[list][i].erase("name");
    if (document.contains("asset")) document["asset"].erase("generator");
}

} // namespace facetmill::io::gltf

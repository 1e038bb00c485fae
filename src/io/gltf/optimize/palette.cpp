// Finds the vertex data that a document's materials need, and makes palettes of plain materials.

#include "geometry/render/srgb.hpp"
#include "io/gltf/document/json.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"
#include "io/images/encode_image.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::io {

using namespace gltf;

namespace {

constexpr const char* unlit = "KHR_materials_unlit";

template <std::size_t n>
bool read_numbers(const Json& owner, const char* key, std::array<double, n>& numbers) {
    const auto found = owner.find(key);
    if (found == owner.end()) return true;
    if (!found->is_array() || found->size() != n) return false;
    for (std::size_t i = 0; i < n; ++i) {
        if (!(*found)[i].is_number()) return false;
        numbers[i] = (*found)[i].get<double>();
    }
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return x >= 0 && x <= 1; });
}

bool read_number(const Json& owner, const char* key, double& number) {
    const auto found = owner.find(key);
    if (found == owner.end()) return true;
    if (!found->is_number()) return false;
    number = found->get<double>();
    return number >= 0 && number <= 1;
}

/// True if the object has only these members.
bool has_only(const Json& object, std::initializer_list<const char*> keys) {
    return std::all_of(object.items().begin(), object.items().end(), [&](const auto& member) {
        return std::find(keys.begin(), keys.end(), member.key()) != keys.end();
    });
}

std::uint8_t byte_of(double fraction) { return static_cast<std::uint8_t>(std::floor(fraction * 255 + 0.5)); }

using PixelOf = std::array<std::uint8_t, 4> (*)(const PlainLook&);

std::array<std::uint8_t, 4> colour_pixel(const PlainLook& look) {
    std::array<std::uint8_t, 4> pixel{0, 0, 0, byte_of(look.colour[3])};
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = srgb_of(static_cast<float>(look.colour[c]));
    return pixel;
}

std::array<std::uint8_t, 4> surface_pixel(const PlainLook& look) {
    return {0, byte_of(look.roughness), byte_of(look.metalness), 255};
}

std::array<std::uint8_t, 4> emission_pixel(const PlainLook& look) {
    std::array<std::uint8_t, 4> pixel{0, 0, 0, 255};
    for (std::size_t c = 0; c < 3; ++c) pixel[c] = srgb_of(static_cast<float>(look.emission[c]));
    return pixel;
}

template <class Member>
bool all_equal(const std::vector<PlainLook>& looks, Member PlainLook::*member) {
    return std::all_of(looks.begin(), looks.end(),
                       [&](const PlainLook& look) { return look.*member == looks.front().*member; });
}

/// Collects the texture coordinate sets that textures anywhere in the object use.
void collect_uvs(const Json& object, std::set<int>& uvs) {
    if (!object.is_structured()) return;
    for (const auto& [key, value] : object.items()) {
        if (key == "extras") continue;
        if (std::string_view(key).ends_with("Texture") && value.is_object() && value.contains("index")) {
            const Json::json_pointer moved("/extensions/KHR_texture_transform/texCoord");
            uvs.insert(value.value("texCoord", 0));
            if (value.contains(moved)) uvs.insert(value[moved].get<int>());
        }
        collect_uvs(value, uvs);
    }
}

/// Adds one to the sets that textures anywhere in the object use, from `first` on.
void move_up(Json& object, int first) {
    if (!object.is_structured()) return;
    const auto move = [&](Json& texture) {
        const int set = texture.value("texCoord", 0);
        if (set >= first) texture["texCoord"] = set + 1;
    };
    for (const auto& [key, value] : object.items()) {
        if (key == "extras") continue;
        if (std::string_view(key).ends_with("Texture") && value.is_object() && value.contains("index")) {
            const Json::json_pointer moved("/extensions/KHR_texture_transform");
            move(value);
            if (value.contains(moved) && value[moved].contains("texCoord")) move(value[moved]);
        }
        move_up(value, first);
    }
}

} // namespace

std::optional<PlainLook> DocumentOptimizer::plain_look(std::size_t material) const {
    const Json& json = json_.at("materials").at(material);
    PlainLook look;
    if (!has_only(json, {"name", "pbrMetallicRoughness", "emissiveFactor", "alphaMode", "alphaCutoff",
                         "doubleSided", "extensions"}))
        return {};
    if (json.contains("extensions") &&
        !(json["extensions"].is_object() && has_only(json["extensions"], {unlit})))
        return {};
    if (!read_numbers(json, "emissiveFactor", look.emission)) return {};
    if (const auto pbr = json.find("pbrMetallicRoughness"); pbr != json.end()) {
        if (!pbr->is_object() || !has_only(*pbr, {"baseColorFactor", "metallicFactor", "roughnessFactor"}) ||
            !read_numbers(*pbr, "baseColorFactor", look.colour) ||
            !read_number(*pbr, "metallicFactor", look.metalness) ||
            !read_number(*pbr, "roughnessFactor", look.roughness))
            return {};
    }
    Json kind = Json::object();
    for (const char* key : {"alphaMode", "alphaCutoff", "doubleSided", "extensions"})
        if (json.contains(key)) kind[key] = json[key];
    look.kind = to_string(kind);
    return look;
}

std::size_t DocumentOptimizer::add_palette(const std::vector<PlainLook>& looks) {
    Json material = parse_document(looks.front().kind);
    material["name"] = "palette";
    const std::size_t sampler = // samples pixels without interpolation
        add("samplers", {{"magFilter", 9728}, {"minFilter", 9728}, {"wrapS", 33071}, {"wrapT", 33071}});
    const auto texture = [&](const char* name, PixelOf pixel_of) {
        Pixels pixels{looks.size(), 1, {}, false};
        for (const PlainLook& look : looks) {
            const auto pixel = pixel_of(look);
            pixels.rgba.insert(pixels.rgba.end(), pixel.begin(), pixel.end());
        }
        const std::size_t image =
            add("images",
                {{"name", name}, {"mimeType", "image/png"}, {"bufferView", add_view(encoded_png(pixels))}});
        return Json{{"index", add("textures", {{"sampler", sampler}, {"source", image}})}};
    };
    Json& pbr = material["pbrMetallicRoughness"] = Json::object();
    if (all_equal(looks, &PlainLook::colour))
        pbr["baseColorFactor"] = looks.front().colour;
    else
        pbr["baseColorTexture"] = texture("palette colours", colour_pixel);
    if (all_equal(looks, &PlainLook::metalness) && all_equal(looks, &PlainLook::roughness)) {
        pbr["metallicFactor"] = looks.front().metalness;
        pbr["roughnessFactor"] = looks.front().roughness;
    } else {
        pbr["metallicRoughnessTexture"] = texture("palette surfaces", surface_pixel);
    }
    if (all_equal(looks, &PlainLook::emission)) {
        material["emissiveFactor"] = looks.front().emission;
    } else {
        material["emissiveTexture"] = texture("palette emission", emission_pixel);
        material["emissiveFactor"] = {1, 1, 1};
    }
    return add("materials", std::move(material));
}

void DocumentOptimizer::forget_materials(const std::set<std::size_t>& meshes,
                                         const std::set<std::size_t>& materials) {
    const std::size_t count = count_of(json_, "materials");
    for (const std::size_t m : meshes)
        for (Json& primitive : json_.at("meshes").at(m)["primitives"])
            if (const auto own = index_at(primitive, "material", count); own && materials.contains(*own))
                primitive.erase("material");
}

void DocumentOptimizer::set_material(std::size_t mesh, std::size_t material) {
    for (Json& primitive : json_.at("meshes").at(mesh)["primitives"])
        if (makes_triangles(JsonCursor(primitive, ""))) primitive["material"] = material;
}

void DocumentOptimizer::move_uvs_up(std::size_t material, int first) {
    move_up(json_.at("materials").at(material), first);
}

MaterialNeeds DocumentOptimizer::needs_of(std::size_t material) const {
    const Json& json = json_.at("materials").at(material);
    MaterialNeeds needs;
    collect_uvs(json, needs.uvs);
    if (const auto map = json.find("normalTexture"); map != json.end() && map->is_object()) {
        const Json::json_pointer moved("/extensions/KHR_texture_transform/texCoord");
        const Json& set = map->contains(moved) ? (*map)[moved] : map->value("texCoord", Json(0));
        needs.tangents = true;
        if (set.is_number_integer() && set >= 0 && set < 100) needs.normal_map_uvs = set.get<int>();
    }
    if (json.contains("extensions") && json["extensions"].is_object())
        for (const auto& [name, value] : json["extensions"].items()) {
            needs.normals = needs.normals && name != unlit;
            needs.tangents |= name == "KHR_materials_clearcoat" || name == "KHR_materials_anisotropy";
        }
    needs.normals |= needs.tangents;
    return needs;
}

} // namespace facetmill::io

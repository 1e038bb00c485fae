#include "io/gltf/contents/atlas_material.hpp"

#include "base/error.hpp"
#include "io/gltf/contents/texture_reference.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <set>

namespace facetmill::io {

using namespace gltf;

namespace {

/// The materials that KHR_animation_pointer animates.
std::set<std::size_t> animated_materials(const Json& document) {
    std::set<std::size_t> animated;
    if (!uses_extension(document, "KHR_animation_pointer")) return animated;
    constexpr std::string_view list = "/materials/";
    const Json::json_pointer place("/target/extensions/KHR_animation_pointer/pointer");
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const Json& animation = document["animations"][a];
        if (!animation.is_object() || !animation.contains("channels")) continue;
        for (const Json& channel : animation["channels"]) {
            if (!channel.contains(place) || !channel.at(place).is_string()) continue;
            const auto pointer = channel.at(place).get<std::string>();
            if (pointer.starts_with(list))
                animated.insert(std::strtoull(pointer.c_str() + list.size(), nullptr, 10));
        }
    }
    return animated;
}

bool names_texture(const Json& json) {
    if (!json.is_structured()) return false;
    for (const auto& [key, value] : json.items())
        if ((std::string_view(key).ends_with("Texture") && value.is_object()) || names_texture(value))
            return true;
    return false;
}

double real_in(const JsonCursor& owner, const char* key, double otherwise) {
    const auto value = owner.find(key);
    return value ? value->real() : otherwise;
}

bool same_coordinates(const Texture& a, const Texture& b) {
    return a.set == b.set && a.transform == b.transform;
}

/// Reads one material.
class AtlasReader {
  public:
    AtlasReader(const Json& document, const JsonCursor& material) : document_(document), place_(material) {}

    AtlasMaterial read() {
        read_kind();
        if (const auto pbr = place_.find("pbrMetallicRoughness")) {
            out_.base = texture(*pbr, "baseColorTexture");
            out_.rough = texture(*pbr, "metallicRoughnessTexture");
            read_numbers_of(*pbr, "baseColorFactor", out_.colour);
            out_.metalness = real_in(*pbr, "metallicFactor", 1);
            out_.roughness = real_in(*pbr, "roughnessFactor", 1);
        }
        out_.normal = texture(place_, "normalTexture");
        out_.occlusion = texture(place_, "occlusionTexture");
        out_.emission = texture(place_, "emissiveTexture");
        if (out_.normal) out_.normal_scale = real_in(place_.at("normalTexture"), "scale", 1);
        if (!(out_.normal_scale > 0)) keep_apart("its normal map has no scale above 0");
        if (out_.occlusion) out_.occlusion_strength = real_in(place_.at("occlusionTexture"), "strength", 1);
        read_emission();
        compare_textures();
        return std::move(out_);
    }

  private:
    void keep_apart(const std::string& why) {
        if (out_.apart.empty()) out_.apart = why;
    }

    void read_kind() {
        Json kind = Json::object();
        const std::string mode = place_.text_or("alphaMode", "OPAQUE");
        if (mode != "OPAQUE") kind["alphaMode"] = mode;
        if (mode == "MASK") kind["alphaCutoff"] = real_in(place_, "alphaCutoff", 0.5);
        if (const auto extras = place_.find("extras")) kind["extras"] = extras->json();
        if (const auto all = place_.find("extensions"))
            for (const auto& [name, value] : all->json().items()) {
                if (name == "KHR_materials_emissive_strength") continue;
                if (name == "KHR_materials_pbrSpecularGlossiness" || name == "MSFT_lod")
                    keep_apart("it uses " + name);
                else if (names_texture(value))
                    keep_apart(name + " has textures");
                kind["extensions"][name] = value;
            }
        out_.kind = to_string(kind);
    }

    void read_emission() {
        read_numbers_of(place_, "emissiveFactor", out_.emissive);
        if (const auto strong = extension_of(place_, "KHR_materials_emissive_strength"))
            for (double& c : out_.emissive) c *= real_in(*strong, "emissiveStrength", 1);
    }

    std::optional<AtlasTexture> texture(const JsonCursor& owner, const char* key) {
        const auto info = owner.find(key);
        if (!info) return {};
        AtlasTexture out;
        out.sampling = sampling_of(document_, *info);
        const auto image = image_of(document_, *info);
        if (image)
            out.image = *image;
        else
            keep_apart(fmt::format("the kind of its {} is not supported", key));
        return out;
    }

    void compare_textures() {
        const AtlasTexture* first = out_.any();
        for (const auto* one : out_.textures()) {
            if (!*one) continue;
            if (!same_coordinates((*one)->sampling, first->sampling))
                keep_apart("its textures use different texture coordinates");
            if ((*one)->sampling.nearest != first->sampling.nearest)
                keep_apart("its textures use different filters");
        }
    }

    const Json& document_;
    const JsonCursor& place_;
    AtlasMaterial out_;
};

} // namespace

std::vector<AtlasMaterial> atlas_materials(const Document& document) {
    const Json json = parse_document(document.json);
    const std::set<std::size_t> animated = animated_materials(json);
    std::vector<AtlasMaterial> all(count_of(json, "materials"));
    for (std::size_t m = 0; m < all.size(); ++m) {
        try { // may fail, because reading checks only meshes
            all[m] = AtlasReader(json, item(json, "materials", m)).read();
        } catch (const Error& error) {
            all[m].apart = "it is broken: " + error.diagnostics().front().message;
        }
        if (animated.contains(m)) all[m].apart = "it is animated";
    }
    return all;
}

} // namespace facetmill::io

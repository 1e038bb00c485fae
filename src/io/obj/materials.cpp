// The glTF equivalents of MTL materials: metallic-roughness, and a dielectric unless Pm is given.

#include "io/obj/materials.hpp"

#include "base/hash.hpp"
#include "base/sort_unique.hpp"
#include "io/images/image_files.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io::obj {

namespace {

double greatest(const Colour& c) { return std::max({c[0], c[1], c[2]}); }

bool has_map(const Description& d, const char* word) { return d.maps.count(word) > 0; }

/// Whether the author used roughness or metalness.
bool is_physical(const Description& d) {
    return d.roughness || d.metalness || has_map(d, "pr") || has_map(d, "pm") || has_map(d, "rma") ||
           has_map(d, "orm");
}

/// Whether the material has highlights: illumination models 0 and 1, and a black Ks, have none.
bool is_glossy(const Description& d) {
    return d.specular && greatest(*d.specular) > 0 && d.illumination.value_or(2) >= 2;
}

Json colour_json(const Colour& c, double factor = 1) {
    return {std::min(c[0] * factor, 1.0), std::min(c[1] * factor, 1.0), std::min(c[2] * factor, 1.0)};
}

/// Replaces black by white if there is a texture, because exporters write black when only the texture should
/// count.
Colour tint(const std::optional<Colour>& colour, bool textured) {
    return colour && !(textured && greatest(*colour) == 0) ? *colour : Colour{1, 1, 1};
}

void add_emission(Json& json, const Description& d, bool textured) {
    if (!d.emission && !textured) return;
    const Colour colour = tint(d.emission, textured);
    const double most = greatest(colour);
    if (most == 0) return;
    json["emissiveFactor"] = colour_json(colour, most > 1 ? 1 / most : 1);
    if (most > 1) json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", most}};
}

/// The name of an image derived from one or two others: "wood-mask.png".
std::filesystem::path derived_name(const Map* first, const Map& second) {
    const std::string stem = second.relative.stem().generic_string();
    if (!first || first->relative == second.relative)
        return second.relative.parent_path() / (stem + "-gltf.png");
    return first->relative.parent_path() /
           fmt::format("{}-{}.png", first->relative.stem().generic_string(), stem);
}

} // namespace

/// The roughness of a highlight with Phong's exponent Ns. Microfacet distributions of equal width have
/// alpha^2 = 2 / (Ns + 2), and glTF's alpha is the square of the roughness. B. Walter, S. R. Marschner, H.
/// Li and K. E. Torrance, "Microfacet models for refraction through rough surfaces" (2007), section 5.2;
/// Phong's exponent is from B. T. Phong, "Illumination for computer generated pictures" (1975).
double roughness_of(double exponent) { return std::sqrt(std::sqrt(2 / (std::max(exponent, 0.0) + 2))); }

MaterialMaker::MaterialMaker(const Input& input, std::map<std::string, Description> descriptions,
                             ReadLog& log, bool names_only)
    : input_(input), descriptions_(std::move(descriptions)), log_(log), names_only_(names_only),
      document_(input.name()) {}

/// Equal operations on equal images give equal images. If only names are needed, the digests of the sources
/// therefore replace the result.
template <class Make>
Bytes MaterialMaker::made(const char* how, const Map* first, const Map* second, Make&& make) {
    if (!names_only_) return make();
    std::string text = how;
    for (const Map* map : {first, second})
        text += map ? " " + sha256(images_.at(map->relative)->bytes) : " none";
    return bytes_of_text(text);
}

void MaterialMaker::warn(const std::string& material, std::string message) {
    log_.warnings.push_back({Severity::warning, "W-MTL",
                             fmt::format("material '{}': {}", material, std::move(message)),
                             file_mark(input_.name()), ""});
}

MaterialMaker::Image* MaterialMaker::image_of(const std::string& material, const std::string& word,
                                              const Map& map) {
    const auto [at, fresh] =
        images_.try_emplace(map.relative.empty() ? std::filesystem::path(map.file) : map.relative);
    if (fresh) {
        const std::string where = fmt::format("material '{}': {}", material, word);
        auto bytes = read_image(input_, map.relative.empty() ? std::nullopt : std::optional(map.relative),
                                map.file, where, log_);
        const std::string type = bytes ? media_type(*bytes) : "";
        if (type == "image/png" || type == "image/jpeg")
            at->second = Image{*std::move(bytes), {}};
        else if (bytes)
            log_.warnings.push_back({Severity::warning, "W-IMAGE",
                                     fmt::format("{}: \"{}\" is neither PNG nor JPEG, as glTF requires, and "
                                                 "is not kept",
                                                 where, map.file),
                                     file_mark(input_.name()), "convert the image to PNG or JPEG"});
    }
    return at->second ? &*at->second : nullptr;
}

const Pixels* MaterialMaker::pixels_of(const std::string& material, const std::string& word, const Map& map) {
    Image* image = image_of(material, word, map);
    if (!image) return nullptr;
    if (!image->pixels) image->pixels = decoded_image(image->bytes);
    if (!image->pixels)
        warn(material, fmt::format("{} \"{}\" cannot be decoded and is not kept", word, map.file));
    return image->pixels ? &*image->pixels : nullptr;
}

/// glTF's reference to the texture. OBJ's v starts at the bottom, so OBJ's t = s (1 - v) + o becomes glTF's
/// 1 - t = s v + (1 - s - o).
Json MaterialMaker::reference(const std::filesystem::path& image, const Bytes& bytes, const Map& map,
                              bool is_file) {
    Json out = {{"index", document_.texture(image, bytes, map.clamp, is_file)}};
    if (map.scale != std::array<double, 2>{1, 1} || map.offset != std::array<double, 2>{0, 0})
        out["extensions"]["KHR_texture_transform"] = {
            {"offset", {map.offset[0], 1 - map.scale[1] - map.offset[1]}},
            {"scale", {map.scale[0], map.scale[1]}}};
    return out;
}

std::optional<Json> MaterialMaker::texture(const std::string& material, const std::string& word,
                                           const Map& map) {
    const Image* image = image_of(material, word, map);
    if (!image) return {};
    return reference(map.relative, image->bytes, map, true);
}

void MaterialMaker::add_colour_maps(Json& json, const std::string& name, const Description& d) {
    if (const auto kd = d.maps.find("kd"); kd != d.maps.end())
        if (auto reference = texture(name, "map_Kd", kd->second))
            json["pbrMetallicRoughness"]["baseColorTexture"] = *std::move(reference);
    const auto ke = d.maps.find("ke");
    auto light = ke == d.maps.end() ? std::nullopt : texture(name, "map_Ke", ke->second);
    add_emission(json, d, light.has_value());
    if (light) json["emissiveTexture"] = *std::move(light);
    if (const auto ks = d.maps.find("ks"); ks != d.maps.end() && !is_physical(d))
        if (auto reference = texture(name, "map_Ks", ks->second))
            json["extensions"]["KHR_materials_specular"]["specularColorTexture"] = *std::move(reference);
}

/// glTF's opacity is the alpha of the colour texture. It is set to the alpha of map_d's image, or to the
/// brightness of an image without alpha.
void MaterialMaker::add_opacity_map(Json& json, const std::string& name, const Description& d) {
    const auto map = d.maps.find("d"), colour = d.maps.find("kd");
    if (map == d.maps.end()) return;
    const Image* image = image_of(name, "map_d", map->second);
    if (!image) return;
    const auto colours = image_colours(image->bytes);
    const bool alpha = colours && colours->alpha;
    Json& pbr = json["pbrMetallicRoughness"];
    const bool coloured = pbr.contains("baseColorTexture");
    if (coloured && !colour->second.lies_as(map->second))
        return warn(
            name,
            fmt::format(
                "the opacity of map_d \"{}\" is not kept: its placement differs from the placement of map_Kd",
                map->second.file));
    if (!coloured || !alpha || colour->second.relative != map->second.relative) {
        const Pixels* opacity = pixels_of(name, "map_d", map->second);
        const Pixels* base = coloured ? pixels_of(name, "map_Kd", colour->second) : nullptr;
        if (!opacity || (coloured && !base)) return;
        const Channel red{base, 0}, green{base, 1}, blue{base, 2};
        const Map* const under = coloured ? &colour->second : nullptr;
        pbr["baseColorTexture"] =
            reference(derived_name(under, map->second),
                      made("opacity", under, &map->second,
                           [&] {
                               return combined_image({red, green, blue, {opacity, alpha ? 3 : brightness}});
                           }),
                      map->second);
    }
    json["alphaMode"] = "BLEND";
}

/// The image with glTF's roughness in green and metalness in blue; none if no map gives them.
std::optional<Json> MaterialMaker::surface_texture(const std::string& name, const Description& d) {
    const auto orm = d.maps.find("orm"), rma = d.maps.find("rma"), pr = d.maps.find("pr"),
               pm = d.maps.find("pm"), none = d.maps.end();
    if (orm != none) return texture(name, "map_ORM", orm->second);
    if (rma != none) {
        const Pixels* p = pixels_of(name, "map_RMA", rma->second);
        if (!p) return {};
        return reference(
            derived_name(nullptr, rma->second),
            made("rma", &rma->second, nullptr,
                 [&] {
                     return combined_image({Channel{p, 2}, Channel{p, 0}, Channel{p, 1}, Channel{}});
                 }),
            rma->second);
    }
    const bool packed = pr != none && pm != none && pr->second == pm->second;
    if (pr != none && (packed || (pm == none && d.metalness.value_or(0) == 0)))
        return texture(name, "map_Pr", pr->second);
    if (pr != none && pm != none && !pr->second.lies_as(pm->second)) {
        warn(name,
             fmt::format("map_Pm \"{}\" is not kept: its placement differs from the placement of map_Pr",
                         pm->second.file));
        return texture(name, "map_Pr", pr->second);
    }
    const Pixels* rough = pr == none ? nullptr : pixels_of(name, "map_Pr", pr->second);
    const Pixels* metal = pm == none ? nullptr : pixels_of(name, "map_Pm", pm->second);
    if (!rough && !metal) return {};
    const Map& map = rough ? pr->second : pm->second;
    const auto make = [&] {
        return combined_image({Channel{}, {rough, brightness}, {metal, brightness}, Channel{}});
    };
    return reference(derived_name(rough && metal ? &pm->second : nullptr, map),
                     made("surface", rough ? &pr->second : nullptr, metal ? &pm->second : nullptr, make),
                     map);
}

/// If the library's factor is missing or 0, the factor becomes 1, so that only the texture counts.
void MaterialMaker::add_surface_maps(Json& json, const std::string& name, const Description& d) {
    auto texture = surface_texture(name, d);
    if (!texture) return;
    Json& pbr = json["pbrMetallicRoughness"];
    const bool all = has_map(d, "orm") || has_map(d, "rma");
    if ((all || has_map(d, "pr")) && d.roughness.value_or(0) == 0) pbr["roughnessFactor"] = 1;
    if ((all || has_map(d, "pm")) && d.metalness.value_or(0) == 0) pbr["metallicFactor"] = 1;
    pbr["metallicRoughnessTexture"] = *texture;
    if (all) json["occlusionTexture"] = *std::move(texture);
}

/// A grey image is a bump map, from which normals are computed; other images hold normals.
void MaterialMaker::add_relief_map(Json& json, const std::string& name, const Description& d) {
    if (const auto norm = d.maps.find("norm"); norm != d.maps.end())
        if (auto normals = texture(name, "norm", norm->second)) {
            if (norm->second.strength != 1) (*normals)["scale"] = norm->second.strength;
            json["normalTexture"] = *std::move(normals);
            return;
        }
    const auto bump = d.maps.find("bump");
    if (bump == d.maps.end()) return;
    const Pixels* pixels = pixels_of(name, "map_Bump", bump->second);
    if (!pixels) return;
    if (is_grey(*pixels)) {
        std::filesystem::path path = derived_name(nullptr, bump->second);
        path.replace_filename(path.stem().generic_string() + "-normals.png");
        const std::string how = fmt::format("relief {}", bump->second.strength);
        json["normalTexture"] =
            reference(path,
                      made(how.c_str(), &bump->second, nullptr,
                           [&] { return normals_of_relief(*pixels, bump->second.strength); }),
                      bump->second);
    } else {
        json["normalTexture"] = texture(name, "map_Bump", bump->second).value();
        if (bump->second.strength != 1) json["normalTexture"]["scale"] = bump->second.strength;
    }
}

Json MaterialMaker::material_json(const std::string& name, const Description& d, bool textured) {
    Json json = {{"name", d.name.value_or(name)}};
    const bool physical = is_physical(d);
    const auto kd = d.maps.find("kd");
    const Colour base =
        tint(d.diffuse, textured && kd != d.maps.end() && image_of(name, "map_Kd", kd->second));
    Json colour = colour_json(base);
    colour.push_back(d.opacity);
    json["pbrMetallicRoughness"] = {{"baseColorFactor", std::move(colour)},
                                    {"metallicFactor", std::clamp(d.metalness.value_or(0), 0.0, 1.0)}};
    if (d.roughness)
        json["pbrMetallicRoughness"]["roughnessFactor"] = std::clamp(*d.roughness, 0.0, 1.0);
    else if (!physical && is_glossy(d) && d.shininess)
        json["pbrMetallicRoughness"]["roughnessFactor"] = roughness_of(*d.shininess);
    if (d.opacity < 1) json["alphaMode"] = "BLEND";
    if (d.double_sided) json["doubleSided"] = true;
    if (!physical && is_glossy(d) && *d.specular != Colour{1, 1, 1})
        json["extensions"]["KHR_materials_specular"]["specularColorFactor"] = *d.specular;
    if (!textured) {
        add_emission(json, d, false);
        return json;
    }
    add_colour_maps(json, name, d);
    add_opacity_map(json, name, d);
    add_surface_maps(json, name, d);
    add_relief_map(json, name, d);
    return json;
}

Index MaterialMaker::index_of(const std::string& name, bool textured, std::vector<Material>& materials) {
    const auto found = descriptions_.find(name);
    if (found == descriptions_.end() || found->second.maps.empty()) textured = false;
    const auto [at, fresh] = known_.try_emplace({name, textured}, static_cast<Index>(materials.size()));
    if (!fresh) return at->second;
    if (found == descriptions_.end()) {
        materials.emplace_back().name = name;
        return at->second;
    }
    const Description& d = found->second;
    materials.push_back(document_.add(material_json(name, d, textured), 0));
    std::vector<std::string> lost = d.left_out;
    for (const auto& [word, map] : d.maps) {
        const auto colour = d.maps.find("kd");
        const bool repeats_colour = word == "ka" && colour != d.maps.end() && colour->second == map;
        for (const char* other : {"ka", "ns", "disp", "decal", "refl", "ps"})
            if (textured && word == other && !repeats_colour) lost.push_back("map_" + word + " " + map.file);
    }
    sort_unique(lost);
    if (!lost.empty() && !known_.count({name, !textured}))
        warn(name, fmt::format("glTF cannot represent {}", fmt::join(lost, ", ")));
    return at->second;
}

void MaterialMaker::finish(Scene& scene) {
    if (!document_.empty()) scene.documents.push_back(document_.finish());
}

} // namespace facetmill::io::obj

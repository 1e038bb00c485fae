#include "io/obj/describe.hpp"

#include "base/text/words.hpp"
#include "io/flatten.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/gltf/document/container.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io::obj {

using gltf::JsonCursor;

namespace {

constexpr const char* no_map = "MTL has no map of it";

std::optional<JsonCursor> extension(const JsonCursor& owner, const char* name) {
    const auto all = owner.find("extensions");
    return all ? all->find(name) : std::nullopt;
}

double number(const JsonCursor& owner, const char* key, double otherwise) {
    const auto value = owner.find(key);
    return value ? value->real() : otherwise;
}

Colour colour(const JsonCursor& owner, const char* key, const Colour& otherwise) {
    const auto value = owner.find(key);
    if (!value) return otherwise;
    return {value->at(std::size_t{0}).real(), value->at(1).real(), value->at(2).real()};
}

/// The Phong exponent, in as few digits as possible, that a reader converts to this roughness.
double exponent_of(double roughness) {
    const double squared = roughness * roughness, exponent = 2 / (squared * squared) - 2;
    for (int digits = 1; digits < 17; ++digits) {
        const std::string text = fmt::format("{:.{}g}", exponent, digits);
        const char* at = text.data();
        double rounded = 0;
        if (scan_real(at, text.data() + text.size(), rounded) && roughness_of(rounded) == roughness)
            return rounded;
    }
    double near = std::nextafter(exponent, 0.0);
    for (int i = 0; i < 4 && roughness_of(near) != roughness; ++i) near = std::nextafter(near, HUGE_VAL);
    return roughness_of(near) == roughness ? near : exponent;
}

bool is_same_texture(const JsonCursor& material, const JsonCursor& pbr) {
    const Json &a = material.find("occlusionTexture")->json(),
               &b = pbr.find("metallicRoughnessTexture")->json();
    return a.contains("index") && b.contains("index") && a["index"] == b["index"];
}

/// Describes a single material.
class Describer {
  public:
    Describer(const Material& material, LibraryImages& images, LibraryLosses& losses)
        : material_(material), images_(images), losses_(losses), json_(images.json(material.document)) {}

    Description run() {
        const JsonCursor place = gltf::item(json_, "materials", static_cast<std::size_t>(material_.index));
        static const Json nothing = Json::object();
        const JsonCursor pbr = place.find("pbrMetallicRoughness").value_or(JsonCursor(nothing, "materials"));
        add_colour(place, pbr);
        out_.double_sided = material_.double_sided;
        add_opacity(place);
        add_light(place);
        add_relief(place);
        add_surface(place, pbr);
        add_highlights(place, pbr);
        note_extensions(place);
        keep_images(place.json());
        return std::move(out_);
    }

  private:
    void lose_texture(const std::string& what, const std::string& why) {
        losses_.add_texture(what, why, material_.name);
    }
    void lose(const std::string& what, const std::string& why) { losses_.add(what, why, material_.name); }

    /// The first readable image of a texture; WebP and KTX2 sources are in extensions.
    const LibraryImages::Image* image_of(const std::string& key, const JsonCursor& texture) {
        std::vector<JsonCursor> sources;
        if (const auto source = texture.find("source")) sources.push_back(*source);
        if (const auto all = texture.find("extensions"))
            for (const auto& [name, _] : all->json().items())
                if (const auto source = all->at(name.c_str()).find("source")) sources.push_back(*source);
        std::string why = "its image is missing";
        for (const JsonCursor& source : sources) {
            const auto* image =
                images_.find(material_.document, source.index(gltf::count_of(json_, "images"), "image"));
            const bool is_read = image && (image->type == "image/png" || image->type == "image/jpeg");
            if (is_read && image->spelled) return image;
            if (image)
                why = is_read
                          ? "MTL cannot store the name of its file; a copy gets another name (textures: copy)"
                          : "its image is neither PNG nor JPEG";
        }
        lose_texture(key, why);
        return nullptr;
    }

    /// True if the image does not repeat. MTL repeats an image in both directions or in none, and has no
    /// statements for filters.
    bool is_clamped(const std::string& key, const JsonCursor& texture) {
        constexpr std::uint64_t nearest = 9728, repeat = 10497, clamp = 33071;
        const auto reference = texture.find("sampler");
        if (!reference) return false;
        const JsonCursor sampler =
            gltf::item(json_, "samplers", reference->index(gltf::count_of(json_, "samplers"), "sampler"));
        const std::uint64_t s = sampler.natural_or("wrapS", repeat), t = sampler.natural_or("wrapT", repeat);
        if (s != t || (s != repeat && s != clamp))
            lose_texture("the wrapping of " + key, "MTL repeats or clamps in both directions");
        if (sampler.natural_or("magFilter", 0) == nearest)
            lose_texture("the filter of " + key, "MTL has none");
        return s == clamp && t == clamp;
    }

    /// The statement that a reader converts to owner[key]. None if the texture is missing, or if MTL cannot
    /// express its coordinates.
    std::optional<Map> map(const JsonCursor& owner, const std::string& key) {
        const auto info = owner.find(key.c_str());
        if (!info) return {};
        Map map;
        const auto moved = extension(*info, "KHR_texture_transform");
        std::uint64_t set = info->natural_or("texCoord", 0);
        if (moved) set = moved->natural_or("texCoord", set);
        if (set != 0) {
            lose_texture(key, "it does not use the first set of texture coordinates");
            return {};
        }
        if (moved && !take_transform(key, *moved, map)) return {};
        const JsonCursor texture = gltf::item(
            json_, "textures", info->at("index").index(gltf::count_of(json_, "textures"), "texture"));
        const auto* image = image_of(key, texture);
        if (!image) return {};
        images_.use(*image);
        map.file = image->name;
        map.clamp = is_clamped(key, texture);
        return map;
    }

    /// The inverse of the reader's conversion: 1 - t = s v + (1 - s - o).
    bool take_transform(const std::string& key, const JsonCursor& moved, Map& map) {
        if (number(moved, "rotation", 0) != 0) {
            lose_texture(key, "it is rotated by KHR_texture_transform");
            return false;
        }
        std::array<double, 2> offset{0, 0};
        for (std::size_t i = 0; i < 2; ++i) {
            if (const auto s = moved.find("scale")) map.scale[i] = s->at(i).real();
            if (const auto o = moved.find("offset")) offset[i] = o->at(i).real();
        }
        map.offset = {offset[0], 1 - map.scale[1] - offset[1]};
        return true;
    }

    /// Omits the map if the factor is black, because readers treat black with a map as white.
    std::optional<Map> map_with(const Colour& factor, const JsonCursor& owner, const std::string& key) {
        if (owner.find(key.c_str()) && std::max({factor[0], factor[1], factor[2]}) == 0) {
            lose_texture(key, "its factor is black");
            return {};
        }
        return map(owner, key);
    }

    void put(const char* word, std::optional<Map> map) {
        if (map) out_.maps[word] = *std::move(map);
    }

    void add_colour(const JsonCursor& material, const JsonCursor& pbr) {
        const auto& base = material_.base_colour;
        out_.diffuse = {base[0], base[1], base[2]};
        alpha_ = base[3];
        if (const auto older = extension(material, "KHR_materials_pbrSpecularGlossiness")) {
            out_.diffuse = colour(*older, "diffuseFactor", {1, 1, 1});
            if (const auto factor = older->find("diffuseFactor")) alpha_ = factor->at(3).real();
            put("kd", map_with(*out_.diffuse, *older, "diffuseTexture"));
        } else {
            put("kd", map_with(*out_.diffuse, pbr, "baseColorTexture"));
        }
    }

    /// glTF states whether alpha applies; in MTL it always applies.
    void add_opacity(const JsonCursor& material) {
        const std::string mode = material.text_or("alphaMode", "OPAQUE");
        if (mode == "OPAQUE") return;
        const auto kd = out_.maps.find("kd");
        const bool by_image = kd != out_.maps.end() && has_alpha(kd->second.file);
        out_.opacity = alpha_;
        if (by_image) out_.maps["d"] = kd->second;
        if (mode != "MASK") return;
        if (!by_image && alpha_ >= number(material, "alphaCutoff", 0.5))
            out_.opacity = 1;
        else
            lose("alphaMode MASK", "it is blended");
    }

    bool has_alpha(const std::string& file) const {
        const auto* image = images_.named(file);
        return image && image->alpha;
    }

    void add_light(const JsonCursor& material) {
        Colour emission = colour(material, "emissiveFactor", {0, 0, 0});
        if (const auto strong = extension(material, "KHR_materials_emissive_strength"))
            for (double& c : emission) c *= number(*strong, "emissiveStrength", 1);
        if (emission != Colour{0, 0, 0}) out_.emission = emission;
        put("ke", map_with(emission, material, "emissiveTexture"));
    }

    void add_relief(const JsonCursor& material) {
        auto normals = map(material, "normalTexture");
        if (normals) normals->strength = number(*material.find("normalTexture"), "scale", 1);
        put("norm", std::move(normals));
    }

    /// Readers interpret the same image in map_Pr and map_Pm as glTF's texture: roughness in green,
    /// metalness in blue. Without metalness, map_Pr alone suffices.
    void add_surface(const JsonCursor& material, const JsonCursor& pbr) {
        const bool older = extension(material, "KHR_materials_pbrSpecularGlossiness").has_value();
        if (older && material.find("occlusionTexture")) lose_texture("occlusionTexture", no_map);
        if (older) return;
        const double rough = number(pbr, "roughnessFactor", 1), metal = number(pbr, "metallicFactor", 1);
        if (metal != 0) out_.metalness = metal;
        if (metal != 0 || pbr.find("roughnessFactor")) out_.roughness = rough;
        const bool has_map = pbr.find("metallicRoughnessTexture").has_value();
        if (has_map && rough == 0)
            lose_texture("metallicRoughnessTexture",
                         "roughnessFactor is 0, which readers take as 1 if map_Pr is present");
        const auto both = rough == 0 ? std::nullopt : map(pbr, "metallicRoughnessTexture");
        put("pr", both);
        if (metal != 0) put("pm", both);
        if (!material.find("occlusionTexture")) return;
        // If occlusion, roughness and metalness use the same image, the image becomes map_ORM.
        const bool whole = number(*material.find("occlusionTexture"), "strength", 1) == 1;
        const auto occlusion = both && metal != 0 && whole && is_same_texture(material, pbr)
                                   ? map(material, "occlusionTexture")
                                   : std::nullopt;
        if (occlusion && *occlusion == *both)
            put("orm", occlusion);
        else
            lose_texture("occlusionTexture", no_map);
    }

    bool is_plain() const {
        return !out_.metalness && !out_.maps.contains("pr") && !out_.maps.contains("orm");
    }

    /// Readers use the colour of highlights only without Pr and Pm. The roughness is then stored as Phong's
    /// exponent.
    void add_highlights(const JsonCursor& material, const JsonCursor& pbr) {
        const auto specular = extension(material, "KHR_materials_specular");
        if (!specular) return;
        if (specular->find("specularTexture")) lose_texture("specularTexture", no_map);
        if (number(*specular, "specularFactor", 1) != 1)
            lose("specularFactor", "MTL has no statement for it");
        const Colour tint = colour(*specular, "specularColorFactor", {1, 1, 1});
        if (!specular->find("specularColorTexture") && tint == Colour{1, 1, 1}) return;
        const bool black = std::max({tint[0], tint[1], tint[2]}) == 0;
        if (!is_plain() || black || out_.roughness == 0.0) {
            const char* const why =
                black ? "a black Ks has no equivalent in glTF" : "MTL cannot combine it with Pr and Pm";
            lose("specularColorFactor", why);
            if (specular->find("specularColorTexture")) lose_texture("specularColorTexture", why);
            return;
        }
        out_.specular = tint;
        out_.illumination = 2;
        out_.roughness.reset();
        if (pbr.find("roughnessFactor")) out_.shininess = exponent_of(number(pbr, "roughnessFactor", 1));
        put("ks", map(*specular, "specularColorTexture"));
    }

    /// Records extensions that no other function reads, and their textures.
    void note_extensions(const JsonCursor& material) {
        const auto all = material.find("extensions");
        if (!all) return;
        for (const auto& [name, value] : all->json().items()) {
            if (extensions_of_library().contains(name)) continue;
            const bool older = name == "KHR_materials_pbrSpecularGlossiness";
            lose(name, older ? "only its diffuse colour is written" : "MTL has no statement for it");
            note_textures(value);
        }
    }

    void note_textures(const Json& json) {
        if (!json.is_object()) return;
        for (const auto& [key, value] : json.items()) {
            if (key.ends_with("Texture") && key != "diffuseTexture") lose_texture(key, no_map);
            note_textures(value);
        }
    }

    /// Marks all planned images as used. A plan includes images even if the library cannot express their
    /// textures.
    void keep_images(const Json& material) {
        for (const std::size_t i : images_of_material(json_, material))
            if (const auto* image = images_.find(material_.document, i); image && image->planned)
                images_.use(*image);
    }

    const Material& material_;
    LibraryImages& images_;
    LibraryLosses& losses_;
    const Json& json_;
    Description out_;
    double alpha_ = 1;
};

} // namespace

const std::set<std::string>& extensions_of_library() {
    static const std::set<std::string> all{"KHR_materials_specular", "KHR_materials_emissive_strength"};
    return all;
}

const std::set<std::string>& kept_by_library() {
    static const std::set<std::string> all = [] {
        std::set<std::string> names = extensions_of_library();
        names.insert({"textures", "KHR_texture_transform"});
        return names;
    }();
    return all;
}

Description describe(const Material& material, LibraryImages& images, LibraryLosses& losses) {
    try {
        if (material.document >= 0 && material.index >= 0) return Describer(material, images, losses).run();
    } catch (const Error& error) { // readers do not check a document beyond its meshes
        losses.add("everything except its colour", error.diagnostics().front().message, material.name);
    }
    Description colour;
    const auto& base = material.base_colour;
    colour.diffuse = {base[0], base[1], base[2]};
    colour.opacity = base[3];
    colour.double_sided = material.double_sided;
    return colour;
}

void LibraryLosses::note(Losses& losses, const std::string& what, const std::string& why,
                         const std::string& material) {
    const std::string text = fmt::format("{} ({})", what, why);
    auto found = std::find_if(losses.begin(), losses.end(), [&](const auto& l) { return l.first == text; });
    if (found == losses.end()) found = losses.insert(found, {text, {}});
    if (found->second.empty() || found->second.back() != material) found->second.push_back(material);
}

std::vector<Diagnostic> LibraryLosses::warnings() const {
    std::vector<Diagnostic> all;
    const auto tell = [&](const char* id, const char* about, const Losses& losses) {
        if (losses.empty()) return;
        std::vector<std::string> texts;
        for (const auto& [what, materials] : losses)
            texts.push_back(fmt::format("of {}: {}", some_of(materials), what));
        all.push_back({Severity::warning,
                       id,
                       fmt::format("{}: {}", about, fmt::join(texts, "; ")),
                       {},
                       "glTF keeps them: write .glb"});
    };
    tell("W-TEXTURES", "textures are not written to OBJ", textures_);
    tell("W-MTL", "MTL cannot represent all of materials", others_);
    return all;
}

} // namespace facetmill::io::obj

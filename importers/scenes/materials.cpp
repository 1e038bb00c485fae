// Materials of assimp as metallic-roughness materials.

#include "convert.hpp"

#include "base/text/percent_encoded.hpp"

#include <algorithm>
#include <assimp/GltfMaterial.h>
#include <cmath>
#include <optional>

namespace importers {

namespace {

constexpr int repeat = 10497, clamp_to_edge = 33071, mirrored = 33648;

int wrap_of(int mode) {
    return mode == aiTextureMapMode_Clamp || mode == aiTextureMapMode_Decal ? clamp_to_edge
           : mode == aiTextureMapMode_Mirror                                ? mirrored
                                                                            : repeat;
}

class Materials {
  public:
    Materials(const aiScene& scene, const SceneFiles& files, Glb& glb, Notes& notes)
        : scene_(scene), files_(files), glb_(glb), notes_(notes) {}

    void add(const aiMaterial& from);

  private:
    struct Map {
        Json info;
        std::string path;
    };
    std::optional<Map> map(const aiMaterial& from, aiTextureType type);
    int image(const std::string& path);
    int embedded(const aiTexture& texture, const std::string& path);
    int sampler(const aiMaterial& from, aiTextureType type);
    void add_transform(const aiMaterial& from, aiTextureType type, Json& info);
    void add_colours(const aiMaterial& from, Json& to);
    void add_roughness(const aiMaterial& from, Json& pbr);

    const aiScene& scene_;
    const SceneFiles& files_;
    Glb& glb_;
    Notes& notes_;
    std::map<std::string, int> images_;
    std::map<std::pair<int, int>, int> samplers_, textures_;
};

int Materials::embedded(const aiTexture& texture, const std::string& path) {
    if (texture.mHeight != 0) {
        notes_.warn("the embedded texture '" + path + "' is not a PNG or JPEG and is dropped");
        return -1;
    }
    const auto bytes =
        std::as_bytes(std::span(reinterpret_cast<const char*>(texture.pcData), texture.mWidth));
    const auto begins = [&](std::string_view magic) {
        return bytes.size() > magic.size() &&
               std::string_view(reinterpret_cast<const char*>(bytes.data()), magic.size()) == magic;
    };
    const bool png = begins("\x89PNG");
    if (!png && !begins("\xff\xd8\xff")) {
        notes_.warn("the embedded texture '" + path + "' is not a PNG or JPEG and is dropped");
        return -1;
    }
    Json item = {{"mimeType", png ? "image/png" : "image/jpeg"}, {"bufferView", glb_.view(bytes)}};
    const std::string stem = std::filesystem::path(texture.mFilename.C_Str()).stem().string();
    if (!stem.empty()) item["name"] = stem;
    return glb_.add("images", std::move(item));
}

int Materials::image(const std::string& path) {
    if (const auto known = images_.find(path); known != images_.end()) return known->second;
    int index = -1;
    if (const aiTexture* texture = scene_.GetEmbeddedTexture(path.c_str())) {
        index = embedded(*texture, path);
    } else {
        std::string name = files_.neighbour(path);
        if (name.empty()) { // facetmill warns of the missing file
            name = path;
            std::replace(name.begin(), name.end(), '\\', '/');
            name = std::filesystem::path(name).filename().string();
        }
        if (!name.empty()) index = glb_.add("images", {{"uri", facetmill::percent_encoded(name)}});
    }
    return images_[path] = index;
}

int Materials::sampler(const aiMaterial& from, aiTextureType type) {
    int u = aiTextureMapMode_Wrap, v = aiTextureMapMode_Wrap;
    from.Get(AI_MATKEY_MAPPINGMODE_U(type, 0), u);
    from.Get(AI_MATKEY_MAPPINGMODE_V(type, 0), v);
    const std::pair wraps{wrap_of(u), wrap_of(v)};
    const auto [at, is_new] = samplers_.try_emplace(wraps, 0);
    if (is_new) at->second = glb_.add("samplers", {{"wrapS", wraps.first}, {"wrapT", wraps.second}});
    return at->second;
}

/// assimp's v points up, and that of glTF down.
void Materials::add_transform(const aiMaterial& from, aiTextureType type, Json& info) {
    aiUVTransform t;
    if (from.Get(AI_MATKEY_UVTRANSFORM(type, 0), t) != AI_SUCCESS) return;
    if (t.mRotation != 0) notes_.warn("the rotation of textures is dropped");
    const Json offset = {t.mTranslation.x, 1 - t.mScaling.y - t.mTranslation.y},
               scale = {t.mScaling.x, t.mScaling.y};
    if (offset == Json{0.0F, 0.0F} && scale == Json{1.0F, 1.0F}) return;
    info["extensions"]["KHR_texture_transform"] = {{"offset", offset}, {"scale", scale}};
    glb_.use_extension("KHR_texture_transform");
}

std::optional<Materials::Map> Materials::map(const aiMaterial& from, aiTextureType type) {
    aiString path;
    if (from.GetTexture(type, 0, &path) != AI_SUCCESS || path.length == 0) return {};
    const int source = image(path.C_Str());
    if (source < 0) return {};
    const auto [texture, is_new] = textures_.try_emplace({source, sampler(from, type)}, 0);
    if (is_new)
        texture->second = glb_.add("textures", {{"sampler", texture->first.second}, {"source", source}});
    Map map{{{"index", texture->second}}, path.C_Str()};
    int set = 0;
    constexpr int most_sets = 7;
    if (from.Get(AI_MATKEY_UVWSRC(type, 0), set) == AI_SUCCESS && set > 0 && set <= most_sets)
        map.info["texCoord"] = set;
    add_transform(from, type, map.info);
    return map;
}

float in_unit(float x) { return std::isfinite(x) ? std::clamp(x, 0.0F, 1.0F) : 0.0F; }

void Materials::add_colours(const aiMaterial& from, Json& to) {
    aiColor4D colour(1, 1, 1, 1), emissive(0, 0, 0, 1);
    if (from.Get(AI_MATKEY_BASE_COLOR, colour) != AI_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
    float opacity = 1;
    from.Get(AI_MATKEY_OPACITY, opacity);
    auto base = map(from, aiTextureType_BASE_COLOR);
    if (!base) base = map(from, aiTextureType_DIFFUSE);
    const auto holes = map(from, aiTextureType_OPACITY);
    if (opacity == 0 && !holes) { // exporters write 0 for "not transparent"
        notes_.warn("materials with opacity 0 become opaque");
        opacity = 1;
    }
    Json& pbr = to["pbrMetallicRoughness"];
    if (base) colour = aiColor4D(1, 1, 1, 1); // a texture replaces the colour
    pbr["baseColorFactor"] = {in_unit(colour.r), in_unit(colour.g), in_unit(colour.b), in_unit(opacity)};
    if (base) pbr["baseColorTexture"] = base->info;
    if (opacity < 1 || (holes && base && holes->path == base->path)) to["alphaMode"] = "BLEND";
    if (holes && (!base || holes->path != base->path))
        notes_.warn("textures of opacity that are not the colour's texture are dropped");
    from.Get(AI_MATKEY_COLOR_EMISSIVE, emissive);
    const auto glow = map(from, aiTextureType_EMISSIVE);
    if (glow) to["emissiveTexture"] = glow->info;
    if (glow) emissive = aiColor4D(1, 1, 1, 1);
    if (emissive.r > 0 || emissive.g > 0 || emissive.b > 0)
        to["emissiveFactor"] = {in_unit(emissive.r), in_unit(emissive.g), in_unit(emissive.b)};
}

/// The roughness of a Phong exponent n is (2 / (n + 2))^(1/4): the distribution of GGX with alpha =
/// roughness^2 then has the width of Blinn and Phong's (Walter et al. 2007).
float roughness_of(float shininess) {
    if (!(shininess > 0)) return 1;
    return std::sqrt(std::sqrt(2 / (shininess + 2)));
}

void Materials::add_roughness(const aiMaterial& from, Json& pbr) {
    float metallic = 0, roughness = 1, shininess = 0;
    from.Get(AI_MATKEY_METALLIC_FACTOR, metallic);
    const bool stated = from.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == AI_SUCCESS;
    from.Get(AI_MATKEY_SHININESS, shininess);
    // For FBX, assimp adds a roughness that it computes from the exponent by another formula.
    constexpr float same = 1e-4F;
    const bool added = shininess > 0 && std::fabs(roughness - (1 - std::sqrt(shininess) / 10)) < same;
    if (!stated || added) roughness = roughness_of(shininess);
    const auto metal = map(from, aiTextureType_METALNESS), rough = map(from, aiTextureType_DIFFUSE_ROUGHNESS);
    if (metal && rough && metal->path == rough->path) {
        pbr["metallicRoughnessTexture"] = metal->info;
        metallic = roughness = 1;
    } else if (metal || rough) {
        notes_.warn("separate textures of metalness and roughness are dropped");
    }
    pbr["metallicFactor"] = in_unit(metallic);
    pbr["roughnessFactor"] = in_unit(roughness);
}

void Materials::add(const aiMaterial& from) {
    Json to = Json::object();
    aiString name;
    if (from.Get(AI_MATKEY_NAME, name) == AI_SUCCESS && name.length > 0) to["name"] = name.C_Str();
    add_colours(from, to);
    add_roughness(from, to["pbrMetallicRoughness"]);
    if (const auto bumps = map(from, aiTextureType_NORMALS)) to["normalTexture"] = bumps->info;
    if (const auto shade = map(from, aiTextureType_AMBIENT_OCCLUSION)) to["occlusionTexture"] = shade->info;
    if (from.GetTextureCount(aiTextureType_HEIGHT) > 0) notes_.warn("bump maps are dropped");
    if (from.GetTextureCount(aiTextureType_SPECULAR) > 0) notes_.warn("textures of highlights are dropped");
    int two_sided = 0;
    if (from.Get(AI_MATKEY_TWOSIDED, two_sided) == AI_SUCCESS && two_sided != 0) to["doubleSided"] = true;
    glb_.add("materials", std::move(to));
}

} // namespace

void add_materials(const aiScene& scene, const SceneFiles& files, Glb& glb, Notes& notes) {
    Materials materials(scene, files, glb, notes);
    for (unsigned i = 0; i < scene.mNumMaterials; ++i) materials.add(*scene.mMaterials[i]);
}

} // namespace importers

#include "io/gltf/contents/resolved_materials.hpp"

#include "io/gltf/contents/texture_reference.hpp"
#include "io/gltf/contents/textures.hpp"

#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/container.hpp"
#include "io/images/avif.hpp"
#include "io/images/pixels.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io {

using namespace gltf;

/// Resolves the materials of one document; holds its parsed JSON.
class LookBuilder {
  public:
    LookBuilder(MaterialResolver& reader, MaterialResolver::OfDocument& known,
                std::vector<Diagnostic>& warnings)
        : reader_(reader), known_(known), warnings_(warnings), json_(parse_document(known.document->json)),
          source_(json_, known.document->buffers) {}

    MaterialLook look(const Material& material) {
        const JsonCursor place = item(json_, "materials", static_cast<std::size_t>(material.index));
        MaterialLook look;
        for (std::size_t c = 0; c < 4; ++c)
            look.base[c] = static_cast<float>(std::clamp(material.base_colour[c], 0.0, 1.0));
        if (const auto pbr = place.find("pbrMetallicRoughness")) {
            look.base_texture = texture(*pbr, "baseColorTexture", true);
            look.roughness = number_or(*pbr, "roughnessFactor", 1);
            look.metalness = number_or(*pbr, "metallicFactor", 1);
            if (reader_.extent_ == MaterialResolver::Extent::all)
                look.rough_texture = texture(*pbr, "metallicRoughnessTexture", false);
        }
        if (const auto old = extension_of(place, "KHR_materials_pbrSpecularGlossiness")) {
            read_numbers_of(*old, "diffuseFactor", look.base);
            look.base_texture = texture(*old, "diffuseTexture", true);
            look.roughness = 1 - number_or(*old, "glossinessFactor", 1);
            look.metalness = 0;
            look.rough_texture = {};
        }
        look.normal_texture = texture(place, "normalTexture", false);
        look.normal_scale = factor(place, "normalTexture", "scale");
        look.occlusion_texture = texture(place, "occlusionTexture", false);
        look.occlusion_strength = std::clamp(factor(place, "occlusionTexture", "strength"), 0.0f, 1.0f);
        look.emissive_texture = texture(place, "emissiveTexture", true);
        read_numbers_of(place, "emissiveFactor", look.emissive);
        if (const auto strong = extension_of(place, "KHR_materials_emissive_strength"))
            for (float& c : look.emissive) c *= number_or(*strong, "emissiveStrength", 1);
        const std::string mode = place.text_or("alphaMode", "OPAQUE");
        look.alpha = mode == "MASK"    ? MaterialLook::Alpha::mask
                     : mode == "BLEND" ? MaterialLook::Alpha::blend
                                       : MaterialLook::Alpha::opaque;
        // A completely invisible material is useless in a picture; MeshLab writes "Tr 1" for opaque
        // materials.
        if (look.alpha == MaterialLook::Alpha::blend && look.base[3] == 0)
            look.alpha = MaterialLook::Alpha::opaque;
        look.cutoff = number_or(place, "alphaCutoff", 0.5f);
        look.unlit = extension_of(place, "KHR_materials_unlit").has_value();
        return look;
    }

  private:
    static float number_or(const JsonCursor& place, const char* key, float otherwise) {
        const auto value = place.find(key);
        return value ? static_cast<float>(value->real()) : otherwise;
    }

    static float factor(const JsonCursor& material, const char* texture, const char* key) {
        const auto place = material.find(texture);
        return place ? number_or(*place, key, 1) : 1;
    }

    /// The texture that owner[key] refers to; none if there is none.
    Texture texture(const JsonCursor& owner, const char* key, bool srgb) {
        const auto info = owner.find(key);
        if (!info) return {};
        Texture out = sampling_of(json_, *info);
        const auto image = image_of(json_, *info);
        if (!image) {
            warn(fmt::format("textures[{}]", info->at("index").natural()),
                 "its image is of an unsupported kind", "convert the image to PNG, JPEG or WebP");
            return {};
        }
        out.image = decoded(*image, srgb);
        return out;
    }

    std::shared_ptr<const TextureImage> decoded(std::size_t index, bool srgb) {
        const auto [place, fresh] = known_.images.try_emplace({index, srgb});
        if (fresh) place->second = read_image(index, srgb);
        return place->second;
    }

    std::shared_ptr<const TextureImage> read_image(std::size_t index, bool srgb) {
        constexpr int max_side = 4096;
        const JsonCursor place = item(json_, "images", index);
        const std::optional<Bytes> bytes = bytes_of_image(place);
        if (!bytes) return nullptr; // reported when the file was read
        const auto size = image_size(*bytes);
        if (size && reader_.bytes_ + texture_bytes(size->first, size->second, max_side) > reader_.most_) {
            warn(index, fmt::format("the images of the scene take more than {} MiB", reader_.most_ >> 20),
                 "use textures: 1024 before the picture to make them smaller");
            return nullptr;
        }
        if (size && size->first > max_pixels / std::max<std::size_t>(1, size->second)) {
            warn(index, fmt::format("it has {} x {} pixels, more than 2^26", size->first, size->second),
                 "make the image at most 8192 x 8192 pixels in the program that made it");
            return nullptr;
        }
        auto pixels = decoded_image(*bytes);
        if (!pixels) {
            warn(index,
                 has_avif() ? "it is broken, or neither PNG, JPEG, WebP nor AVIF"
                            : "it is broken, or neither PNG nor JPEG nor WebP",
                 "export the image again");
            return nullptr;
        }
        auto image = texture_image(static_cast<int>(pixels->width), static_cast<int>(pixels->height),
                                   std::move(pixels->rgba), srgb, max_side);
        reader_.bytes_ += image->bytes();
        return image;
    }

    std::optional<Bytes> bytes_of_image(const JsonCursor& place) {
        if (const auto uri = place.find("uri")) {
            if (is_data_uri(uri->text())) return data_uri_bytes(uri->text());
            const auto file = known_.document->files.find(uri->text());
            if (file == known_.document->files.end()) return {};
            return file->second;
        }
        const Span view = source_.view(place.at("bufferView"));
        return Bytes(view.begin(), view.end());
    }

    void warn(const std::string& place, const std::string& why, const std::string& hint) {
        warnings_.push_back({Severity::warning, "W-TEXTURE", fmt::format("{}: not drawn: {}", place, why),
                             file_mark(known_.document->name), hint + "; the plain colour is drawn instead"});
    }
    /// Warns about an image, by its index and, if it has one, its name.
    void warn(std::size_t index, const std::string& why, const std::string& hint) {
        const std::string place = fmt::format("images[{}]", index);
        const std::string name = name_of_image(json_["images"][index], index);
        warn(name == place ? place : fmt::format("{} ({})", place, name), why, hint);
    }

    MaterialResolver& reader_;
    MaterialResolver::OfDocument& known_;
    std::vector<Diagnostic>& warnings_;
    Json json_;
    Source source_;
};

void MaterialResolver::drop_others(const Scene& scene) {
    std::erase_if(documents_, [&](const auto& known) {
        return std::none_of(scene.documents.begin(), scene.documents.end(),
                            [&](const auto& document) { return document.get() == known.first; });
    });
    bytes_ = 0;
    for (const auto& [_, known] : documents_)
        for (const auto& [key, image] : known.images)
            if (image) bytes_ += image->bytes();
}

std::shared_ptr<const ResolvedMaterials> MaterialResolver::materials(const Scene& scene,
                                                                     std::vector<Diagnostic>& warnings) {
    drop_others(scene);
    auto all = std::make_shared<ResolvedMaterials>();
    std::map<const Document*, LookBuilder> builders;
    for (const Material& material : scene.materials) {
        MaterialLook& look = all->emplace_back();
        for (std::size_t c = 0; c < 4; ++c) look.base[c] = static_cast<float>(material.base_colour[c]);
        if (material.document < 0 || material.index < 0) continue;
        const auto& document = scene.documents[static_cast<std::size_t>(material.document)];
        OfDocument& known = documents_[document.get()];
        known.document = document;
        if (const auto found = known.materials.find(material.index); found != known.materials.end()) {
            look = found->second;
            continue;
        }
        try { // may fail, because reading checks only meshes
            const auto builder = builders.try_emplace(document.get(), *this, known, warnings).first;
            look = builder->second.look(material);
        } catch (const Error& error) {
            for (const Diagnostic& d : error.diagnostics())
                warnings.push_back({Severity::warning, "W-TEXTURE", "not drawn: " + d.message,
                                    file_mark(document->name), d.hint});
        }
        known.materials[material.index] = look;
    }
    return all;
}

} // namespace facetmill::io

#include "io/gltf/contents/textures.hpp"

#include "base/hash.hpp"
#include "base/text/words.hpp"
#include "io/gltf/document/builder.hpp"
#include "io/gltf/document/container.hpp"
#include "io/images/image_files.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io {

using namespace gltf;

namespace {

/// An extension for an image type that core glTF lacks.
struct KindOfImage {
    const char* type;
    const char* extension;
};
constexpr KindOfImage kinds_by_extension[] = {{"image/avif", "EXT_texture_avif"},
                                              {"image/webp", "EXT_texture_webp"},
                                              {"image/ktx2", "KHR_texture_basisu"}};

/// owner[key] if it is an object, otherwise null.
const Json* object_at(const Json& owner, const char* key) {
    if (!owner.is_object()) return nullptr;
    const auto found = owner.find(key);
    return found != owner.end() && found->is_object() ? &*found : nullptr;
}

// --- the uses of images

/// How a texture with this name in a material is used, by glTF 2.0 and its extensions.
ImageUse use_of(const std::string& name) {
    static const std::set<std::string> colours = {"baseColorTexture",
                                                  "emissiveTexture",
                                                  "diffuseTexture",
                                                  "specularGlossinessTexture",
                                                  "sheenColorTexture",
                                                  "specularColorTexture",
                                                  "diffuseTransmissionColorTexture"};
    static const std::set<std::string> without_alpha = {
        "metallicRoughnessTexture", "occlusionTexture", "clearcoatTexture",   "clearcoatRoughnessTexture",
        "transmissionTexture",      "thicknessTexture", "iridescenceTexture", "iridescenceThicknessTexture",
        "anisotropyTexture"};
    ImageUse use;
    use.colours = colours.contains(name);
    use.normals = name == "normalTexture" || name == "clearcoatNormalTexture";
    use.numbers = !use.colours && !use.normals;
    use.alpha = name == "specularGlossinessTexture" || (use.numbers && !without_alpha.contains(name));
    use.textures = {name};
    return use;
}

/// Walks through a document and collects the uses of its images.
class Uses {
  public:
    explicit Uses(const Json& json)
        : json_(json), images_(count_of(json, "images")), textures_(count_of(json, "textures")),
          all_(images_) {}

    std::vector<ImageUse> of_document(const std::set<int>& held) {
        for (std::size_t m = 0; m < count_of(json_, "materials"); ++m) {
            held_ = held.contains(static_cast<int>(m));
            const Json& material = json_["materials"][m];
            const auto mode = material.is_object() ? material.find("alphaMode") : material.end();
            covers_ = material.is_object() && mode != material.end() && (*mode == "MASK" || *mode == "BLEND");
            walk_material(material);
        }
        hold_features(json_);
        hold_lights();
        return std::move(all_);
    }

  private:
    void walk_material(const Json& json) {
        if (!json.is_object()) return;
        for (const auto& [name, value] : json.items()) {
            if (name == "extras") continue;
            const auto texture =
                name.ends_with("Texture") ? index_at(value, "index", textures_) : std::nullopt;
            if (texture) use_texture(*texture, name);
            walk_material(value);
        }
    }

    void use_texture(std::size_t index, const std::string& name) {
        ImageUse use = use_of(name);
        use.held = held_;
        use.nearest = is_nearest(json_["textures"][index]);
        use.coverage = covers_ && (name == "baseColorTexture" || name == "diffuseTexture");
        use.alpha |= use.coverage;
        each_image(index, [&](std::size_t image) { all_[image].join(use); });
    }

    bool is_nearest(const Json& texture) const {
        constexpr int nearest = 9728;
        const auto sampler = index_at(texture, "sampler", count_of(json_, "samplers"));
        if (!sampler) return false;
        const Json& filters = json_["samplers"][*sampler];
        return index_at(filters, "magFilter") == nearest && index_at(filters, "minFilter") == nearest;
    }

    /// Calls call(image) for each image of a texture. Marks the core image as a fallback if an extension has
    /// another.
    template <class Call>
    void each_image(std::size_t index, Call&& call) {
        const Json& texture = json_["textures"][index];
        const auto source = index_at(texture, "source", images_);
        if (source) call(*source);
        const Json* extensions = object_at(texture, "extensions");
        if (!extensions) return;
        for (const auto& [name, value] : extensions->items())
            if (const auto other = index_at(value, "source", images_)) {
                call(*other);
                if (source) all_[*source].fallback = true;
            }
    }

    void hold(std::size_t image) { all_[image].held = true; }

    /// Marks images whose channels hold numbers of EXT_structural_metadata or EXT_mesh_features.
    void hold_features(const Json& json) {
        if (!json.is_structured()) return;
        if (json.is_object() && json.contains("channels"))
            if (const auto texture = index_at(json, "index", textures_))
                each_image(*texture, [&](std::size_t image) { hold(image); });
        for (const auto& [key, value] : json.items())
            if (key != "extras") hold_features(value);
    }

    void hold_lights() {
        const Json::json_pointer path("/extensions/EXT_lights_image_based/lights");
        if (!json_.contains(path) || !json_[path].is_array()) return;
        for (const Json& light : json_[path])
            if (light.is_object() && light.contains("specularImages")) hold_all(light["specularImages"]);
    }
    void hold_all(const Json& images) {
        if (images.is_number_unsigned() && images.get<std::size_t>() < images_)
            hold(images.get<std::size_t>());
        if (images.is_array())
            for (const Json& one : images) hold_all(one);
    }

    const Json& json_;
    std::size_t images_, textures_;
    std::vector<ImageUse> all_;
    bool held_ = false, covers_ = false; ///< state of the current material
};

/// The bytes of an image; empty if they are not available.
Bytes bytes_of_image(const Document& document, Source& source, const Json& image) {
    if (!image.is_object()) return {};
    const auto uri = image.find("uri");
    if (uri != image.end()) {
        if (!uri->is_string()) return {};
        const auto text = uri->get<std::string>();
        if (is_data_uri(text)) return data_uri_bytes(text);
        const auto file = document.files.find(text);
        return file == document.files.end() ? Bytes{} : file->second;
    }
    const auto view = index_at(image, "bufferView", count_of(source.json(), "bufferViews"));
    if (!view || source.without_bytes(*view)) return {};
    const Span bytes = source.view(*view);
    return {bytes.begin(), bytes.end()};
}

// --- replacing images

/// Replaces images in a copy of a document.
class Replacing {
  public:
    Replacing(const Document& document, const std::map<std::size_t, Bytes>& replaced)
        : out_(document), json_(parse_document(document.json)), replaced_(replaced) {}

    std::shared_ptr<const Document> run() {
        for (const auto& [index, bytes] : replaced_) {
            Json& image = json_["images"][index];
            types_[index] = media_type(bytes);
            if (image.contains("uri") && !is_data_uri(image["uri"].get<std::string>()))
                put_file(image, bytes, types_[index]);
            else
                put_view(image, bytes, types_[index]);
        }
        for (auto& [uri, bytes] : files_) out_.files[uri] = std::move(bytes);
        drop_unnamed_files(out_.files, json_);
        for (std::size_t t = 0; t < count_of(json_, "textures"); ++t) point(json_["textures"][t]);
        if (!types_.empty())
            for (const KindOfImage& kind : kinds_by_extension) list_extension(kind.extension);
        out_.json = to_string(json_);
        return std::make_shared<const Document>(std::move(out_));
    }

  private:
    /// Images that shared a file and still have equal bytes continue to share it.
    void put_file(Json& image, const Bytes& bytes, const std::string& type) {
        const auto old = image["uri"].get<std::string>();
        const std::string before = media_type(out_.files[old]);
        if (image.contains("mimeType")) image["mimeType"] = type;
        const auto [place, fresh] = renamed_.try_emplace({old, type}, old);
        if (fresh && before != type) {
            const std::filesystem::path path = decoded_path(old).value_or("image");
            const auto named = [&](const std::string& more) {
                return uri_of(path.parent_path() /
                              (path.stem().generic_string() + more + suffix_of_image(type)));
            };
            place->second = named("");
            for (int n = 2; out_.files.contains(place->second); ++n)
                place->second = named(fmt::format(".{}", n));
        }
        if (fresh) files_[place->second] = bytes;
        image["uri"] = place->second;
        if (fresh) out_.files.try_emplace(place->second);
    }

    void put_view(Json& image, const Bytes& bytes, const std::string& type) {
        std::size_t view = 0;
        const auto old = index_at(image, "bufferView", count_of(json_, "bufferViews"));
        const auto known = old ? views_.find(*old) : views_.end();
        if (known != views_.end()) {
            view = known->second;
        } else {
            Json& buffers = list_of("buffers");
            buffers.push_back({{"byteLength", bytes.size()}});
            out_.buffers.resize(buffers.size());
            out_.buffers.back() = bytes;
            Json fresh = {{"buffer", buffers.size() - 1}, {"byteLength", bytes.size()}};
            if (old && is_alone(*old)) { // keeping the number avoids changing other references
                view = *old;
                json_["bufferViews"][view] = std::move(fresh);
            } else {
                Json& views = list_of("bufferViews");
                views.push_back(std::move(fresh));
                view = views.size() - 1;
            }
            if (old) views_[*old] = view;
        }
        image.erase("uri");
        image["mimeType"] = type;
        image["bufferView"] = view;
    }

    Json& list_of(const char* name) {
        Json& list = json_[name];
        if (!list.is_array()) list = Json::array();
        return list;
    }

    /// True if only replaced images use the view.
    bool is_alone(std::size_t view) {
        std::size_t all = 0, ours = 0;
        visit_view_references(json_, [&](Json& r) { all += r == view; });
        for (const auto& [index, _] : replaced_)
            ours += index_at(json_["images"][index], "bufferView", view + 1) == view;
        return all == ours;
    }

    /// Moves the image references of a texture to the extensions of their kinds.
    void point(Json& texture) {
        if (!texture.is_object()) return;
        const auto type = [&](std::optional<std::size_t> image) {
            const auto found = image ? types_.find(*image) : types_.end();
            return found == types_.end() ? std::string() : found->second;
        };
        const std::size_t images = count_of(json_, "images");
        for (const KindOfImage& kind : kinds_by_extension) { // needed for an image whose kind has changed
            const Json* extensions = object_at(texture, "extensions");
            const Json* named = extensions ? object_at(*extensions, kind.extension) : nullptr;
            const auto image = named ? index_at(*named, "source", images) : std::nullopt;
            if (!image || type(image).empty() || type(image) == kind.type) continue;
            texture["source"] = *image;
            texture["extensions"].erase(kind.extension);
            if (texture["extensions"].empty()) texture.erase("extensions");
        }
        const auto source = index_at(texture, "source", images);
        for (const KindOfImage& kind : kinds_by_extension) {
            if (!source || type(source) != kind.type) continue;
            texture.erase("source");
            texture["extensions"][kind.extension] = {{"source", *source}};
        }
    }

    void list_extension(const char* extension) {
        bool used = false, required = false;
        for (std::size_t t = 0; t < count_of(json_, "textures"); ++t) {
            const Json* extensions = object_at(json_["textures"][t], "extensions");
            if (!extensions || !extensions->contains(extension)) continue;
            used = true;
            required |= !json_["textures"][t].contains("source");
        }
        for (const auto& [list, listed] :
             {std::pair("extensionsUsed", used), {"extensionsRequired", required}}) {
            remove_name(json_, list, extension);
            if (listed) add_name(json_, list, extension);
            erase_empty(json_, list);
        }
    }

    Document out_;
    Json json_;
    const std::map<std::size_t, Bytes>& replaced_;
    std::map<std::size_t, std::string> types_; ///< media types of replaced images
    std::map<std::pair<std::string, std::string>, std::string>
        renamed_;                              ///< new names by old name and new type
    std::map<std::string, Bytes> files_;       ///< files with new bytes
    std::map<std::size_t, std::size_t> views_; ///< new views by old view
};

} // namespace

void ImageUse::join(const ImageUse& other) {
    colours |= other.colours;
    normals |= other.normals;
    numbers |= other.numbers;
    coverage |= other.coverage;
    alpha |= other.alpha;
    nearest |= other.nearest;
    fallback |= other.fallback;
    held |= other.held;
    for (const auto& name : other.textures)
        if (std::find(textures.begin(), textures.end(), name) == textures.end()) textures.push_back(name);
}

std::vector<DocumentImage> document_images(const Document& document, const std::set<int>& held) {
    const Json json = parse_document(document.json);
    std::vector<ImageUse> uses = Uses(json).of_document(held);
    std::vector<Bytes> bytes = image_bytes(document, json);
    std::vector<DocumentImage> all;
    for (std::size_t i = 0; i < uses.size(); ++i)
        all.push_back({i, name_of_image(json["images"][i], i), std::move(bytes[i]), std::move(uses[i])});
    return all;
}

std::string name_of_image(const Json& image, std::size_t index) {
    if (image.is_object() && image.contains("name") && image["name"].is_string())
        if (const auto name = image["name"].get<std::string>(); !name.empty()) return name;
    if (image.is_object() && image.contains("uri") && image["uri"].is_string())
        if (const auto uri = image["uri"].get<std::string>(); !is_data_uri(uri))
            if (const auto path = decoded_path(uri)) return path->filename().generic_string();
    return fmt::format("images[{}]", index);
}

std::vector<Bytes> image_bytes(const Document& document, const Json& json) {
    Source source(json, document.buffers);
    std::vector<Bytes> all(count_of(json, "images"));
    for (std::size_t i = 0; i < all.size(); ++i) {
        try { // reading checks only meshes, so this may throw
            all[i] = bytes_of_image(document, source, json["images"][i]);
        } catch (const Error&) {
            all[i].clear(); // write or render reports the error
        }
    }
    return all;
}

std::vector<ImageFile> image_files(const Document& document, const Json& json) {
    std::vector<Bytes> bytes = image_bytes(document, json);
    std::vector<ImageFile> files, embedded;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i].empty()) continue;
        const Json& image = json["images"][i];
        std::string uri = image.contains("uri") ? image["uri"].get<std::string>() : "";
        if (!uri.empty() && !is_data_uri(uri)) {
            auto path = decoded_path(uri).value_or("image");
            files.push_back({i, std::move(path), std::move(uri), std::move(bytes[i])});
            continue;
        }
        const bool named = image.contains("name") && image["name"].is_string();
        auto name = file_name_of_image(named ? image["name"].get<std::string>() : "", i, bytes[i]);
        embedded.push_back({i, std::move(name), {}, std::move(bytes[i])});
    }
    std::move(embedded.begin(), embedded.end(), std::back_inserter(files));
    return files;
}

std::optional<PlaceOfFile> place_of_file(const Document& document, const std::string& uri,
                                         const std::filesystem::path& directory) {
    namespace fs = std::filesystem;
    const auto path = decoded_path(uri);
    if (!path) return {};
    std::error_code failed;
    const fs::path from = fs::absolute(fs::path(document.name).parent_path() / *path, failed);
    const fs::path to = fs::absolute(directory.empty() ? "." : directory, failed);
    if (failed) return {};
    return PlaceOfFile{from, from.lexically_normal().lexically_relative(to.lexically_normal())};
}

std::shared_ptr<const Document> with_images(const Document& document,
                                            const std::map<std::size_t, Bytes>& replaced) {
    return Replacing(document, replaced).run();
}

} // namespace facetmill::io

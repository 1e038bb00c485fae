// Finds the images of materials that are used for drawing.

#include "base/hash.hpp"
#include "base/text/words.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/images/image_files.hpp"

namespace facetmill::io {

using namespace gltf;

namespace {

/// The images of a material, one by one; skips malformed references.
class ImagesOfMaterial {
  public:
    ImagesOfMaterial(const Json& document, std::set<std::size_t>& images)
        : document_(document), images_(images) {}

    void add(const Json& json) {
        if (!json.is_object()) return;
        for (const auto& [key, value] : json.items()) {
            if (key.ends_with("Texture") && value.is_object()) add_texture(texture_of(value));
            add(value);
        }
    }

  private:
    void add_texture(const Json& texture) {
        add_source(texture);
        if (const auto all = texture.find("extensions"); all != texture.end() && all->is_object())
            for (const auto& extension : *all) add_source(extension);
    }

    void add_source(const Json& owner) {
        const auto source = owner.find("source");
        if (source != owner.end() && source->is_number_unsigned()) images_.insert(source->get<std::size_t>());
    }

    /// The texture, or an empty object.
    const Json& texture_of(const Json& reference) const {
        static const Json nothing = Json::object();
        const auto all = document_.find("textures"), index = reference.find("index");
        if (all == document_.end() || index == reference.end() || !index->is_number_unsigned())
            return nothing;
        const auto i = index->get<std::size_t>();
        return all->is_array() && i < all->size() && (*all)[i].is_object() ? (*all)[i] : nothing;
    }

    const Json& document_;
    std::set<std::size_t>& images_;
};

} // namespace

std::set<std::size_t> images_of_material(const Json& document, const Json& material) {
    std::set<std::size_t> images;
    ImagesOfMaterial(document, images).add(material);
    return images;
}

namespace gltf {

std::set<std::size_t> drawn_materials(const Json& document, const std::vector<Placement>& placements) {
    std::set<std::size_t> used;
    for (const Placement& placement : placements) {
        const JsonCursor primitives =
            item(document, "meshes", static_cast<std::size_t>(placement.mesh)).at("primitives");
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (const auto material = primitives.at(i).find("material"))
                used.insert(material->index(count_of(document, "materials"), "material"));
    }
    // A document of points uses all materials.
    if (placements.empty())
        for (std::size_t m = 0; m < count_of(document, "materials"); ++m) used.insert(m);
    return used;
}

} // namespace gltf

LibraryImageNames library_images(const std::filesystem::path& file,
                                 const std::vector<std::filesystem::path>& asset_roots) {
    LibraryImageNames names;
    std::set<std::filesystem::path> used_names;
    try {
        const Input input = Input::open(file).with_asset_roots(asset_roots);
        const Codec* codec = sure_codec(input);
        if (!codec || !codec->can.honours("quantize")) return {};
        const bool binary = is_glb(input.bytes());
        const Chunks chunks =
            binary ? split_glb(input.bytes()) : Chunks{without_byte_order_mark(as_text(input.bytes())), {}};
        const Json json = parse_document(chunks.json);
        std::set<std::size_t> used;
        for (const std::size_t m : drawn_materials(json, placements(json, node_frames(json))))
            used.merge(images_of_material(json, json["materials"][m]));
        const auto sort = [&](std::size_t image, const std::filesystem::path& name) {
            (used.contains(image) ? used_names : names.idle).insert(name);
        };
        for (std::size_t i = 0; i < count_of(json, "images"); ++i)
            if (const auto uri = item(json, "images", i).find("uri"); uri && !is_data_uri(uri->text()))
                if (const auto path = decoded_path(uri->text())) sort(i, *path);
        ReadLog ignored; // reading the file will report it
        Document document;
        document.buffers = load_buffers(json, chunks.binary, input, ignored);
        for (const ImageFile& image : image_files(document, json)) {
            if (!image.uri.empty() || !image_colours(image.bytes)) continue;
            names.embedded.push_back({image.relative, sha256(image.bytes), false});
            sort(image.index, image.relative);
        }
        for (const auto& name : used_names) names.idle.erase(name);
    } catch (const Error&) { // the image will not be written either
    }
    return names;
}

} // namespace facetmill::io

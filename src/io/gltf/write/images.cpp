// The images of a written document: in it, beside it, or where they are.

#include "base/hash.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/write/patch.hpp"
#include "io/images/image_faults.hpp"
#include "io/images/image_files.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace fs = std::filesystem;

namespace {

/// An image of the document that is named as a file.
struct FileImage {
    std::size_t index;
    std::string uri;
    const Document* document; ///< that it comes from
    const Bytes* bytes;       ///< null when it was not read
};

std::vector<FileImage> file_images(Patch& patch, const ImageOwners& owners) {
    std::vector<FileImage> all;
    for (std::size_t i = 0; i < count_of(patch.builder.json(), "images"); ++i) {
        const auto uri = item(patch.builder.json(), "images", i).find("uri");
        if (!uri || is_data_uri(uri->text())) continue;
        const auto owner = owners.find(i);
        const int d = owner == owners.end() ? patch.base : owner->second;
        const Document* document = patch.scene.documents[static_cast<std::size_t>(d)].get();
        const auto found = document->files.find(uri->text());
        all.push_back({i, uri->text(), document, found == document->files.end() ? nullptr : &found->second});
    }
    return all;
}

Json& image_json(Patch& patch, const FileImage& image) { return patch.builder.json()["images"][image.index]; }

void warn_of_fault(Patch& patch, std::size_t index, const std::string& fault) {
    if (fault.empty()) return;
    const Diagnostic d = warning_of_fault(name_of_image(patch.builder.json()["images"][index], index), fault);
    patch.warn("W-IMAGE", d.message, d.hint);
}

/// What is wrong with an image that stands in a buffer or in the document itself.
std::string embedded_fault(Patch& patch, const JsonCursor& image) {
    const auto uri = image.find("uri"), view = image.find("bufferView");
    if (uri) return is_data_uri(uri->text()) ? image_fault(data_uri_bytes(uri->text())) : std::string();
    if (!view) return {};
    try { // reading a document looks no further than meshes
        const std::size_t number = view->index(count_of(patch.builder.json(), "bufferViews"), "buffer view");
        Source& now = patch.builder.current();
        return now.without_bytes(number) ? std::string() : image_fault(now.view(number));
    } catch (const Error& error) {
        return error.diagnostics().front().message;
    }
}

/// The name of the image's file, as a name of the image.
void keep_name(Json& json, const std::string& uri) {
    const auto path = decoded_path(uri);
    if (!json.contains("name") && path) json["name"] = path->stem().string();
}

/// Where images go that are embedded or copied; the same bytes go there once.
class Placer {
  public:
    Placer(Patch& patch, const std::string& stem) : patch_(patch), names_(stem) {}

    void embed(const FileImage& image) {
        const std::string type = media_type(*image.bytes);
        if (type.empty()) return copy(image); // told as a fault
        const auto [view, fresh] = views_.try_emplace(sha256(*image.bytes), 0);
        if (fresh) view->second = patch_.builder.add_view(*image.bytes);
        Json& json =
            image_json(patch_, image); // only now: a view that is added may move what stands beside it
        json.erase("uri");
        keep_name(json, image.uri);
        json["mimeType"] = type;
        json["bufferView"] = view->second;
    }

    void copy(const FileImage& image) {
        const auto [path, fresh] = copies_.try_emplace(sha256(*image.bytes));
        if (fresh) {
            path->second = names_.add(decoded_path(image.uri).value_or("image"));
            files_.push_back({path->second, *image.bytes});
        }
        image_json(patch_, image)["uri"] = uri_of(path->second);
    }

    std::vector<OutputFile> files() { return std::move(files_); }

  private:
    Patch& patch_;
    ImageNames names_;
    std::map<std::string, std::size_t> views_; ///< by the digest of the bytes
    std::map<std::string, fs::path> copies_;
    std::vector<OutputFile> files_;
};

/// Names the image by the way from the output's directory to where it lies.
void refer(Patch& patch, Placer& placer, const FileImage& image) {
    const auto place = place_of_file(*image.document, image.uri, patch.settings.directory);
    if (!place) return; // remote or absolute: stays as spelled
    // Made while it was read, or by a stage.
    if (image.bytes && !has_bytes(place->file, *image.bytes)) return placer.copy(image);
    image_json(patch, image)["uri"] = uri_of(place->way);
}

} // namespace

std::vector<OutputFile> place_images(Patch& patch, const ImageOwners& owners, const std::string& stem,
                                     Textures textures) {
    for (std::size_t i = 0; i < count_of(patch.builder.json(), "images"); ++i)
        warn_of_fault(patch, i, embedded_fault(patch, item(patch.builder.json(), "images", i)));
    Placer placer(patch, stem);
    for (const FileImage& image : file_images(patch, owners)) {
        if (textures == Textures::reference)
            refer(patch, placer, image);
        else if (!image.bytes)
            patch.warn("W-IMAGE",
                       fmt::format("images[{}].uri: the image \"{}\" was not read and is not copied",
                                   image.index, image.uri));
        else {
            warn_of_fault(patch, image.index, image_fault(*image.bytes));
            if (textures == Textures::embed)
                placer.embed(image);
            else
                placer.copy(image);
        }
    }
    return placer.files();
}

} // namespace facetmill::io::gltf

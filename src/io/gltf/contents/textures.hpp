#pragma once
// The images of a glTF document, their uses by its materials, and a copy of the document with replaced
// images.

#include "base/json.hpp"
#include "io/codec.hpp"
#include "mesh/scene.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <set>

namespace facetmill::io {

/// How all materials of a document use an image.
struct ImageUse {
    bool colours = false;  ///< red, green and blue in sRGB
    bool normals = false;  ///< a tangent-space normal map
    bool numbers = false;  ///< metalness, roughness, occlusion, thickness ...
    bool coverage = false; ///< alpha is coverage, in a material that masks or blends
    bool alpha = false;    ///< alpha is used, as coverage or as a number
    bool nearest = false;  ///< sampled without interpolation, for example a palette
    bool fallback = false; ///< the fallback for readers without the extension that gives another image
    bool held = false;     ///< used outside the selected materials, so it must stay unchanged
    std::vector<std::string> textures; ///< names in materials, such as "baseColorTexture", each once

    /// Adds the uses of other.
    void join(const ImageUse& other);
};

/// An image of a document.
struct DocumentImage {
    std::size_t index = 0;
    std::string name; ///< the image's name, otherwise its file's name, otherwise its index: "images[3]"
    Bytes bytes;      ///< empty if missing or not read
    ImageUse use;
};

/// The images of the document, by index. held: materials whose images must stay unchanged. Images that
/// EXT_structural_metadata, EXT_mesh_features or EXT_lights_image_based use are held too. Invalid references
/// are skipped. Throws a malformed-input error when the document is not JSON.
[[nodiscard]] std::vector<DocumentImage> document_images(const Document& document, const std::set<int>& held);
/// The name of an image in messages: its own name, otherwise its file's name, otherwise its index:
/// "images[3]".
[[nodiscard]] std::string name_of_image(const Json& image, std::size_t index);
/// The bytes of the document's images, given its parsed JSON; empty for images that are missing or were not
/// read.
[[nodiscard]] std::vector<Bytes> image_bytes(const Document& document, const Json& json);

/// An image of a document as a file: the named file, or a generated name for an embedded image.
struct ImageFile {
    std::size_t index = 0; ///< index in the document
    std::filesystem::path relative;
    std::string uri; ///< URI of a separate file, or empty
    Bytes bytes;
};
/// The images with available bytes: first files, then embedded images, each by index.
[[nodiscard]] std::vector<ImageFile> image_files(const Document& document, const Json& json);

/// The images that a material of the document uses. Invalid references are skipped.
[[nodiscard]] std::set<std::size_t> images_of_material(const Json& document, const Json& material);

/// The data of a glTF file that formats with image libraries need for planning.
struct LibraryImageNames {
    std::vector<NamedImage>
        embedded; ///< embedded images of types that libraries name, with the names of image_files
    /// Embedded images and image files that no drawn material uses.
    std::set<std::filesystem::path> idle;
};
/// Empty for other formats and unreadable files.
[[nodiscard]] LibraryImageNames library_images(const std::filesystem::path& file,
                                               const std::vector<std::filesystem::path>& asset_roots);

/// The location of a file that a relative URI names.
struct PlaceOfFile {
    std::filesystem::path file, way; ///< relative to the directory
};
/// None if the URI is remote or absolute. An empty directory means the working directory.
[[nodiscard]] std::optional<PlaceOfFile> place_of_file(const Document& document, const std::string& uri,
                                                       const std::filesystem::path& directory);

/// A copy of the document with new bytes (PNG, JPEG, WebP or KTX2) for some images, by index. If an image's
/// kind changes, its name, media type and textures change too. WebP becomes the source of EXT_texture_webp,
/// KTX2 the source of KHR_texture_basisu. The extension is required unless every such texture has a fallback.
/// Images in buffers and data URIs get their own buffer views. Everything else keeps its index.
[[nodiscard]] std::shared_ptr<const Document> with_images(const Document& document,
                                                          const std::map<std::size_t, Bytes>& replaced);

} // namespace facetmill::io

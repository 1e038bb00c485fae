#pragma once
// The images of a glTF document and what its materials use them for, and the document with other images in
// their place.

#include "base/json.hpp"
#include "io/codec.hpp"
#include "mesh/scene.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <set>

namespace facetmill::io {

/// What an image is used for, by all materials of its document.
struct ImageUse {
    bool colours = false;  ///< red, green and blue in sRGB
    bool normals = false;  ///< a tangent-space normal map
    bool numbers = false;  ///< metalness, roughness, occlusion, thickness ...
    bool coverage = false; ///< alpha says how much is there: of a material that masks or blends
    bool alpha = false;    ///< alpha is read, as coverage or as a number
    bool nearest = false;  ///< read pixel by pixel, without mixing: a palette, say
    bool fallback = false; ///< beside another image, for readers that do not know an extension
    bool held = false;     ///< something other than the materials asked for names it: it has to stay as it is
    std::vector<std::string> textures; ///< what materials call it, "baseColorTexture", each once

    /// What is said of either.
    void join(const ImageUse& other);
};

/// An image of a document.
struct DocumentImage {
    std::size_t index = 0;
    std::string name; ///< its own, else its file's, else its place: "images[3]"
    Bytes bytes;      ///< none when they were not read, or are not there
    ImageUse use;
};

/// The images of the document, by index. held: materials of the document whose images stay as they are. What
/// EXT_structural_metadata, EXT_mesh_features and EXT_lights_image_based read from images is held, too. A
/// reference to nothing is passed over. Throws malformed when the document is no JSON.
std::vector<DocumentImage> document_images(const Document& document, const std::set<int>& held);
/// What messages call an image of a document: its own name, else its file's, else its place: "images[3]".
std::string name_of_image(const Json& image, std::size_t index);
/// The bytes of the images of the document, whose JSON is given parsed; none for those that were not read or
/// are not there.
std::vector<Bytes> image_bytes(const Document& document, const Json& json);

/// An image of a document as a file: where the document names it, or, when it is in the document itself,
/// under a name made for it.
struct ImageFile {
    std::size_t index = 0; ///< in the document
    std::filesystem::path relative;
    std::string uri; ///< of one that is a file; else empty
    Bytes bytes;
};
/// Those whose bytes are there: first the files, then what is in the document itself, each by index.
std::vector<ImageFile> image_files(const Document& document, const Json& json);

/// The images that a material of the document names. A reference to nothing is passed over.
std::set<std::size_t> images_of_material(const Json& document, const Json& material);

/// What a plan of a format that names images in a library needs to know of a glTF file.
struct LibraryImageNames {
    std::vector<NamedImage> embedded; ///< of the kinds that libraries name, as image_files calls them
    /// Of these and of the files that it names, those of no material that something is drawn with.
    std::set<std::filesystem::path> idle;
};
/// Nothing of a file of another format, or that cannot be read.
LibraryImageNames library_images(const std::filesystem::path& file,
                                 const std::vector<std::filesystem::path>& asset_roots);

/// Where the file is that a relative URI of a document names.
struct PlaceOfFile {
    std::filesystem::path file, way; ///< from the directory
};
/// None when the URI is remote or absolute. directory: empty is the working one.
std::optional<PlaceOfFile> place_of_file(const Document& document, const std::string& uri,
                                         const std::filesystem::path& directory);

/// The document with other bytes (PNG, JPEG, WebP or KTX2) for some of its images, by index. Where an image's
/// kind changes, its name, its media type and the textures do as well: WebP becomes the source of
/// EXT_texture_webp and KTX2 that of KHR_texture_basisu, which is required unless every such texture has
/// another image, too. Images in buffers and in data URIs become views of buffers of their own; all else is
/// where it was.
std::shared_ptr<const Document> with_images(const Document& document,
                                            const std::map<std::size_t, Bytes>& replaced);

} // namespace facetmill::io

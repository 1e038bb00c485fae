#pragma once
// The images that an OBJ's library names. They come from the scene's documents, and are copied next to the
// OBJ or referenced where they are.

#include "base/json.hpp"
#include "io/codec.hpp"
#include "io/images/image_files.hpp"

namespace facetmill::io::obj {

/// The images of all documents of a scene. Every image gets a name in the order of the documents, used or
/// not, so that names agree with the plan.
class LibraryImages {
  public:
    LibraryImages(const Scene& scene, const WriteSettings& settings);

    struct Image {
        std::string name; ///< as the library spells it: a path with slashes
        Bytes bytes;
        std::string type; ///< for example "image/png"
        bool alpha = false;
        bool copied =
            false; ///< true if written under this name; otherwise the name refers to an existing file
        bool planned = false; ///< true if a plan lists it: a file, or an image type that a library names
        bool spelled = true;  ///< true if a library can spell the name
        bool used = false;
    };
    /// The document's parsed JSON. document: an index into the scene's documents.
    const Json& json(int document);
    /// Null if the image's bytes are missing. document: an index into the scene's documents; index: into its
    /// images.
    const Image* find(int document, std::size_t index) const;
    /// The image with this name, or null.
    const Image* named(const std::string& name) const;
    void use(const Image& image);

    /// The files of images that are used and copied; moves their bytes out.
    std::vector<OutputFile> take_files();
    /// Warnings about used images that viewers cannot show.
    std::vector<Diagnostic> warnings() const;

  private:
    void add(std::size_t document, ImageNames& names, std::map<std::string, std::size_t>& by_digest);

    const Scene& scene_;
    const WriteSettings& settings_;
    std::vector<Json> documents_;
    std::vector<Image> images_; ///< distinct images
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> places_;
};

} // namespace facetmill::io::obj

#pragma once
// The images that an OBJ's library names: those of a scene's documents, as files beside the OBJ or where they
// lie.

#include "base/json.hpp"
#include "io/codec.hpp"
#include "io/images/image_files.hpp"

namespace facetmill::io::obj {

/// The images of all documents of a scene. Every one has a name, in the order of the documents, so that those
/// which are used have the names that a plan has told.
class LibraryImages {
  public:
    LibraryImages(const Scene& scene, const WriteSettings& settings);

    struct Image {
        std::string name; ///< as the library spells it: a path, with slashes
        Bytes bytes;
        std::string type; ///< image/png ...
        bool alpha = false;
        bool copied = false;  ///< to that name, else it lies there
        bool planned = false; ///< a plan tells of it: a file, or of a kind that a library names
        bool spelled = true;  ///< a line of a library can name it
        bool used = false;
    };
    /// The document's JSON, parsed. document: an index into the scene's.
    const Json& json(int document);
    /// Null when its bytes are not there. document: an index into the scene's; index: of its images.
    const Image* find(int document, std::size_t index) const;
    /// The one of that name, or null.
    const Image* named(const std::string& name) const;
    void use(const Image& image);

    /// The files of those that are used and copied. They have no bytes afterwards.
    std::vector<OutputFile> take_files();
    /// About those that are used, where viewers cannot show them.
    std::vector<Diagnostic> warnings() const;

  private:
    void add(std::size_t document, ImageNames& names, std::map<std::string, std::size_t>& by_digest);

    const Scene& scene_;
    const WriteSettings& settings_;
    std::vector<Json> documents_;
    std::vector<Image> images_; ///< different ones
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> places_;
};

} // namespace facetmill::io::obj

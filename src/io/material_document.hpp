#pragma once
// Materials of formats other than glTF, told as glTF has them: a document with materials, textures and images
// and nothing else, so that what writes glTF has one way to take over materials.

#include "base/json.hpp"
#include "io/codec.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io {

/// Collects materials. Images that are asked for twice are one.
class MaterialDocument {
  public:
    /// name: of the file that images are named relative to.
    explicit MaterialDocument(std::string name);

    /// The index of a texture of the image, which is named by its path relative to the file. clamp: it is not
    /// repeated outside of [0, 1]. Another image of the same name gets a number.
    /// is_file: the bytes are those of the file of that name.
    std::size_t texture(const std::filesystem::path& image, const std::vector<std::byte>& bytes, bool clamp,
                        bool is_file = true);
    /// Adds a material as glTF has it; an extension that it uses is listed. Returns it for a scene whose
    /// documents are `documents` so far.
    Material add(Json material, std::size_t documents);
    /// What finish() would name as files.
    std::vector<NamedImage> images() const;
    bool empty() const { return json_["materials"].empty(); }
    /// The document, to be the scene's next one.
    std::shared_ptr<const Document> finish();

  private:
    std::size_t find_or_add(const char* list, const Json& value);
    void list_extensions(const Json& json);

    Document document_;
    Json json_;
    std::vector<NamedImage> images_; ///< without digests
};

/// The images of a document that its materials name, each once, in the order in which a written document
/// takes them over.
std::vector<std::size_t> images_of_materials(const Json& document);

} // namespace facetmill::io

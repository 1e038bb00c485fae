#pragma once
// Materials of formats other than glTF as a glTF document with only materials, textures and images. The glTF
// writer thus has a single way to copy materials.

#include "base/json.hpp"
#include "io/codec.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io {

/// Collects materials. An image that is requested twice is stored once.
class MaterialDocument {
  public:
    /// name: the file that image paths are relative to.
    explicit MaterialDocument(std::string name);

    /// The index of a texture of the image, which is named by its path relative to the file. clamp: do not
    /// repeat the image outside [0, 1]. A different image with the same name gets a number. is_file: the
    /// bytes come from the file with this name. nearest: sample it without interpolation.
    std::size_t texture(const std::filesystem::path& image, const std::vector<std::byte>& bytes, bool clamp,
                        bool is_file = true, bool nearest = false);
    /// Adds a glTF material and lists the extensions that it uses. Returns the material for a scene that has
    /// `documents` documents so far.
    Material add(Json material, std::size_t documents);
    /// The document's asset, for a copyright and extras.
    Json& asset() { return json_["asset"]; }
    /// The images that finish() would name as files.
    std::vector<NamedImage> images() const;
    /// Whether it has nothing to keep.
    bool empty() const { return json_["materials"].empty() && json_["asset"].size() == 1; }
    /// The document, to be appended to the scene's documents.
    std::shared_ptr<const Document> finish();

  private:
    std::size_t find_or_add(const char* list, const Json& value);
    void list_extensions(const Json& json);

    Document document_;
    Json json_;
    std::vector<NamedImage> images_; ///< without digests
};

/// The images that the document's materials name, each once, in the order in which a written document copies
/// them.
[[nodiscard]] std::vector<std::size_t> images_of_materials(const Json& document);

} // namespace facetmill::io

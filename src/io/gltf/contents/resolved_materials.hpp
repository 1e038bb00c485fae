#pragma once
// The materials of a scene as a picture draws them: the images of its documents decoded, samplers, transforms
// and factors read. Materials of other formats are told as glTF has them (io/material_document.hpp), so this
// is the one way for all.

#include "base/error.hpp"
#include "geometry/render/texture.hpp"
#include "mesh/scene.hpp"

#include <map>
#include <utility>

namespace facetmill::io {

/// Reads looks, and keeps what it has decoded as long as the scene has its document, so that each image is
/// decoded once however many pictures there are of a scene as it goes from stage to stage.
class MaterialResolver {
  public:
    /// max_bytes: of decoded images.
    explicit MaterialResolver(std::size_t max_bytes = std::size_t{512} << 20) : most_(max_bytes) {}

    /// By the index of the scene's materials. One that blends with an alpha of 0 is opaque. An image that is
    /// missing, broken, of a kind that is not read, or of more than 2^26 pixels is left out, and so is what
    /// goes beyond max_bytes of decoded images in all: a warning (W-TEXTURE), once for each image. Levels of
    /// more than 4096 pixels a side are not kept.
    std::shared_ptr<const ResolvedMaterials> materials(const Scene& scene, std::vector<Diagnostic>& warnings);

  private:
    friend class LookBuilder;
    using ImageKey = std::pair<std::size_t, bool>; ///< its index in the document, in sRGB
    struct OfDocument {
        std::shared_ptr<const Document> document; ///< kept, so that its address stays its own
        std::map<ImageKey, std::shared_ptr<const TextureImage>> images;
        std::map<int, MaterialLook> materials; ///< by the index of the document's materials
    };
    void drop_others(const Scene& scene); ///< documents that the scene does not have

    std::map<const Document*, OfDocument> documents_;
    std::size_t bytes_ = 0; ///< of all images
    std::size_t most_;
};

} // namespace facetmill::io

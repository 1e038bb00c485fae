#pragma once
// Prepares the materials of a scene for rendering: decoded images, samplers, texture transforms and factors.
// Materials of other formats are converted to glTF first (io/material_document.hpp), so one implementation
// handles all.

#include "base/error.hpp"
#include "geometry/render/texture.hpp"
#include "mesh/scene.hpp"

#include <map>
#include <utility>

namespace facetmill::io {

/// Resolves materials, and caches decoded images as long as the scene has their document. So each image is
/// decoded once even if several stages render the scene.
class MaterialResolver {
  public:
    /// Whether to resolve MaterialLook::rough_texture too, which pictures do not need.
    enum class Extent { pictures, all };
    /// max_bytes: limit for decoded images.
    explicit MaterialResolver(std::size_t max_bytes = std::size_t{512} << 20,
                              Extent extent = Extent::pictures)
        : most_(max_bytes), extent_(extent) {}

    /// The resolved materials, by the scene's material index. A blending material with an alpha of 0 becomes
    /// opaque. An image is skipped if it is missing, broken, unsupported or larger than 2^26 pixels, or if
    /// it would exceed max_bytes in total. Each skipped image gives one warning (W-TEXTURE). Levels of more
    /// than 4096 pixels a side are not kept.
    std::shared_ptr<const ResolvedMaterials> materials(const Scene& scene, std::vector<Diagnostic>& warnings);

  private:
    friend class LookBuilder;
    using ImageKey = std::pair<std::size_t, bool>; ///< index in the document, and whether it is in sRGB
    struct OfDocument {
        std::shared_ptr<const Document> document; ///< kept alive, so that no other document gets its address
        std::map<ImageKey, std::shared_ptr<const TextureImage>> images;
        std::map<int, MaterialLook> materials; ///< materials by index in the document
    };
    void drop_others(const Scene& scene); ///< drops documents that the scene no longer has

    std::map<const Document*, OfDocument> documents_;
    std::size_t bytes_ = 0; ///< the total size of all images
    std::size_t most_;
    Extent extent_;
};

} // namespace facetmill::io

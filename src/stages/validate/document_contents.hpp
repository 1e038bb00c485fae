#pragma once
// The contents of glTF documents besides meshes: images and extensions.

#include "mesh/scene.hpp"

#include <string>
#include <vector>

namespace facetmill::validate_stage {

/// A document's image. Width and height come from PNG, JPEG and WebP headers; for other formats they are 0.
struct DocumentImage {
    std::string name; ///< its name, its uri, or "image 3"
    std::size_t width = 0, height = 0;
    std::size_t pixels() const { return width * height; }
};
/// All images in the documents' lists, and image files outside these lists.
[[nodiscard]] std::vector<DocumentImage> images_of(const Scene& scene);

/// The name of the only node with meshes at the top of the scene, if it has a transform. Parts without a
/// document count as such nodes.
[[nodiscard]] std::vector<std::string> moved_root_nodes(const Scene& scene);

/// An extension that a document lists as used.
struct DocumentExtension {
    std::string name, document;
};
/// Sorted by name, each once per document.
[[nodiscard]] std::vector<DocumentExtension> extensions_of(const Scene& scene);

} // namespace facetmill::validate_stage

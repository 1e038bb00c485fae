#pragma once
// What glTF documents hold besides meshes: images, bytes, extensions.

#include "mesh/scene.hpp"

#include <string>
#include <vector>

namespace facetmill::validate_stage {

/// An image of a document, a PNG, JPEG or WebP by its header; of others the sides are 0.
struct DocumentImage {
    std::string name; ///< its name, its uri, or "image 3"
    std::size_t width = 0, height = 0;
    std::size_t pixels() const { return width * height; }
};
/// All images of the documents' lists of images, and files that no list names.
std::vector<DocumentImage> images_of(const Scene& scene);

/// A share of a document's bytes: its JSON, a buffer or an image beside it.
struct DocumentBytes {
    std::string name; ///< "body.glb: JSON", "body.glb: buffer 0", "wood.png"
    std::size_t bytes = 0;
};
std::vector<DocumentBytes> bytes_of(const Scene& scene);

/// An extension that a document names as used.
struct DocumentExtension {
    std::string name, document;
};
/// By name, once for each document.
std::vector<DocumentExtension> extensions_of(const Scene& scene);

} // namespace facetmill::validate_stage

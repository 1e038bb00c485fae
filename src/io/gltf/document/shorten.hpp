#pragma once
// Shortens the JSON text of a document.

#include "base/math/vec.hpp"
#include "io/gltf/document/json.hpp"

#include <vector>

namespace facetmill::io::gltf {

/// Floating-point numbers that are whole become integers. Numbers of materials keep only the digits of
/// float32. Members with default values are removed. Matrices that only translate and scale become a
/// translation and a scale. Numbers of nodes lose digits that move nothing by more than 1e-8 of the bounds'
/// diagonal. Extras stay unchanged. worlds: [nodes] their largest transforms to the world; empty: their
/// transforms at rest.
void shorten(Json& document, const Box& bounds, const std::vector<Transform>& worlds = {});

/// Erases the names of nodes, meshes, images and other items that only people use, and the asset's generator.
/// Keeps the names of scenes, animations, cameras and materials.
void drop_names(Json& document);

} // namespace facetmill::io::gltf

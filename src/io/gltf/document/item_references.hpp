#pragma once
// References to the textures, images, samplers and materials of a document.

#include "io/gltf/document/json.hpp"

#include <functional>

namespace facetmill::io::gltf {

inline constexpr const char* variants_extension = "KHR_materials_variants";

/// Textures are referenced by materials ("...Texture"), by sets of feature ids ("texture"), and by everything
/// that reads their channels.
void visit_texture_references(Json& json, const std::function<void(Json&)>& visit);
void visit_image_references(Json& document, const std::function<void(Json&)>& visit);
void visit_sampler_references(Json& document, const std::function<void(Json&)>& visit);
/// Materials are referenced by primitives, and by materials whose levels of detail they are (MSFT_lod).
void visit_material_references(Json& document, const std::function<void(Json&)>& visit);

} // namespace facetmill::io::gltf

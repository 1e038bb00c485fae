#pragma once
// The inverse bind matrices of skins.

#include "io/gltf/document/accessor.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io::gltf {

/// Of a skin of so many joints, 16 numbers each, column by column. Throws malformed (E-GLTF) where its
/// accessor is none of that kind.
std::vector<float> bind_matrices(Source& source, const JsonCursor& skin, std::size_t joints);

/// Of 16 numbers, column by column.
Transform from_columns(const float* numbers);

} // namespace facetmill::io::gltf

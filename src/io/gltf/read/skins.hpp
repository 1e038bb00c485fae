#pragma once
// The inverse bind matrices of skins.

#include "io/gltf/document/accessor.hpp"
#include "mesh/scene.hpp"

namespace facetmill::io::gltf {

/// The matrices of a skin with this many joints, 16 numbers each, column by column. Throws a malformed-input
/// error (E-GLTF) if its accessor has another type or size.
[[nodiscard]] std::vector<float> bind_matrices(Source& source, const JsonCursor& skin, std::size_t joints);

/// A transform from 16 numbers, column by column.
[[nodiscard]] Transform from_columns(const float* numbers);

} // namespace facetmill::io::gltf

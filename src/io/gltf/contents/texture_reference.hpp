#pragma once
// Reads how a material refers to a texture.

#include "geometry/render/texture.hpp"
#include "io/gltf/document/json.hpp"

namespace facetmill::io::gltf {

/// The sampling of the texture that a material's member ("baseColorTexture") refers to, without its image:
/// the set, the wrapping and the transform.
[[nodiscard]] Texture sampling_of(const Json& document, const JsonCursor& info);
/// The number of its image, of a kind that this build can decode if there is one; none if the texture has
/// only images of unknown kinds.
[[nodiscard]] std::optional<std::size_t> image_of(const Json& document, const JsonCursor& info);
/// Copies the numbers owner[key], if present, to the array.
template <class Number, std::size_t N>
void read_numbers_of(const JsonCursor& owner, const char* key, std::array<Number, N>& out) {
    const auto values = owner.find(key);
    for (std::size_t i = 0; values && i < N; ++i) out[i] = static_cast<Number>(values->at(i).real());
}
/// owner.extensions[name], if present.
[[nodiscard]] std::optional<JsonCursor> extension_of(const JsonCursor& owner, const char* name);

} // namespace facetmill::io::gltf

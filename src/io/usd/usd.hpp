#pragma once
// USDZ (OpenUSD's package for phones): a zip of a text layer and its textures. The layer is made from the
// glTF that the scene would be written as, so both formats get the same hierarchy and materials.

#include "io/codec.hpp"

namespace facetmill::io::usd {

/// Reads the shapes of a file that facetmill wrote. Throws malformed (E-USDZ, E-ZIP).
[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);
/// 2 for a zip that begins with a layer.
[[nodiscard]] int sniff(Span bytes);
/// Skinned and morphed parts are in bind pose, as in other formats without skins.
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::usd

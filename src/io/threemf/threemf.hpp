#pragma once
// 3MF (3D Manufacturing Format): a zip archive of XML models with units, objects, components and items to
// build. Supports core specification 1.3, colours of the materials extension, and model parts of the
// production extension.

#include "io/codec.hpp"

namespace facetmill::io::threemf {

[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::threemf

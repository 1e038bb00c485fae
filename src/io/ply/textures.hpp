#pragma once
// Images named by `TextureFile` comments in a PLY, a convention of some programs.

#include "io/codec.hpp"
#include "io/material_document.hpp"

#include <optional>
#include <string>

namespace facetmill::io::ply {

/// Adds a material with `texture`, a path relative to the file, to the document. None, with a warning, if
/// the image cannot be read or glTF does not support its type.
std::optional<Material> material_of(MaterialDocument& document, const Input& input,
                                    const std::string& texture, ReadLog& log);

} // namespace facetmill::io::ply

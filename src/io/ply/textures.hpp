#pragma once
// Images that the comments `TextureFile` of a PLY name, as some programs write them.

#include "io/codec.hpp"
#include "io/material_document.hpp"

#include <optional>
#include <string>

namespace facetmill::io::ply {

/// A material of `texture`, a path relative to the file, added to the document. None, with a warning, when
/// the image cannot be read or is of no kind that glTF has.
std::optional<Material> material_of(MaterialDocument& document, const Input& input,
                                    const std::string& texture, ReadLog& log);

} // namespace facetmill::io::ply

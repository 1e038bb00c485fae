#pragma once
// What the bytes of a file are spent on.

#include "io/bytes.hpp"

#include <cstdint>
#include <string>

namespace facetmill::io {

struct ByteKinds {
    std::uint64_t geometry = 0; ///< meshes, and what else buffers hold: animations, skins
    std::uint64_t textures = 0;
    std::uint64_t json = 0; ///< the description: the JSON of glTF, or a file of materials
};

/// Of a GLB or a glTF by its contents: images in the file are textures, even as text, and so are the views of
/// its own buffer that hold images. Of any other file by its name. What cannot be read is geometry. bytes:
/// those of the file, or none of them where only its size is known.
ByteKinds byte_kinds(const std::string& name, std::uint64_t size, Span bytes);

} // namespace facetmill::io

#pragma once
// The kinds of data that a file consists of.

#include "io/bytes.hpp"

#include <cstdint>
#include <string>

namespace facetmill::io {

struct ByteKinds {
    std::uint64_t geometry = 0; ///< meshes and other buffer data: animations, skins
    std::uint64_t textures = 0;
    std::uint64_t json = 0; ///< the JSON of glTF, or a file of materials
};

/// Classifies the bytes of a file. GLB and glTF are classified by contents: images embedded as text or in
/// buffer views count as textures. Other files are classified by name. Unreadable contents count as
/// geometry. bytes: the file's contents, or empty if only the size is known.
[[nodiscard]] ByteKinds byte_kinds(const std::string& name, std::uint64_t size, Span bytes);

} // namespace facetmill::io

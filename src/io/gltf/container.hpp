#pragma once
// The GLB container: a header of 12 bytes, a JSON chunk and perhaps a binary one, each padded to 4 bytes.

#include "io/bytes.hpp"

#include <optional>

namespace facetmill::io::gltf {

/// True when the bytes begin with the GLB magic number.
bool is_glb(Span bytes);

/// The chunks of a container, pointing into it.
struct Chunks {
    std::string_view json;
    std::optional<Span> binary;
};
/// Throws malformed (E-GLB) with the byte offset of what is wrong. Chunks of unknown kinds are skipped.
Chunks split_glb(Span bytes);
/// The container of a document and its buffer (none when empty). Throws limit (E-SIZE) beyond 4 GiB, which
/// the header cannot say.
Bytes join_glb(std::string_view json, Span binary);

} // namespace facetmill::io::gltf

#pragma once
// STL: triangles without indices, text or binary.

#include "io/codec.hpp"

namespace facetmill::io::stl {

/// Whether these bytes are STL text rather than binary: headers of binary files may begin with "solid" too,
/// so the size that a binary file's count asks for decides first.
bool is_text(Span bytes);

/// Of binary files: bytes before the triangles, and of each.
inline constexpr std::size_t head = 84, record = 50;

/// How many triangles the head of a binary file says there are. It must be there.
std::uint32_t promised_triangles(Span bytes);
/// As many; malformed (E-STL) where the file does not hold its head, or fewer.
std::uint32_t held_triangles(const Input& input);

/// One part per solid, welded exactly. Normals in the file are not looked at: the order of the corners
/// counts. Attribute bytes, where a file has any that are not zero, become the face attribute "attribute".
Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);

/// Triangles as float32, their normals computed from what is written. Text has one solid per part.
Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::stl

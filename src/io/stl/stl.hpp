#pragma once
// STL: triangles without indices, text or binary.

#include "io/codec.hpp"

namespace facetmill::io::stl {

/// Whether these bytes are STL text. Binary headers may also begin with "solid", so it first compares the
/// file's size with the triangle count of a binary header.
bool is_text(Span bytes);

/// Binary files: the number of bytes before the triangles, and per triangle.
inline constexpr std::size_t head = 84, record = 50;

/// The number of triangles in the head of a binary file. The head must be complete.
[[nodiscard]] std::uint32_t promised_triangles(Span bytes);
/// The same number, checked against the file's size. Throws a malformed-input error (E-STL) if the file
/// lacks its head or has fewer triangles.
[[nodiscard]] std::uint32_t held_triangles(const Input& input);

/// One part per solid, welded exactly. The reader ignores the file's normals, because the order of the
/// corners defines the orientation. Nonzero attribute bytes become the face attribute "attribute".
[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);

/// Writes triangles as float32, with normals computed from the rounded corners. Text has one solid per part.
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::stl

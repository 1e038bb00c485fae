#pragma once
// STL: triangles without indices, text or binary.

#include "io/codec.hpp"

namespace facetmill::io::stl {

/// Whether these bytes are STL text. Binary headers may also begin with "solid", so the size expected from a
/// binary file's count decides first, and bytes of zero, which no text has.
bool is_text(Span bytes);

/// Binary files: the number of bytes before the triangles, and per triangle.
inline constexpr std::size_t head = 84, record = 50;

/// The number of triangles in the head of a binary file. The head must be complete.
[[nodiscard]] std::uint32_t promised_triangles(Span bytes);
/// The same number, checked. Some programs leave it out (0, or all bits set): if only whole triangles follow,
/// all of them count. Throws malformed (E-STL) if the file lacks its head or has fewer triangles.
[[nodiscard]] std::uint32_t held_triangles(const Input& input);

/// The meaning of the two attribute bytes after a triangle: five bits for each colour, and a sixteenth bit.
enum class Colouring {
    none,
    viscam, ///< blue in the lowest bits; the sixteenth bit is set if the triangle has a colour
    magics, ///< red in the lowest bits; the sixteenth bit is set if the triangle has the header's colour
};
/// Of a binary file. Magics states its colours in the head ("COLOR="). Else a triangle with the sixteenth bit
/// is one of VisCAM.
[[nodiscard]] Colouring colouring_of(const Input& input);
/// The words in the head of a file with colours of VisCAM, by which a part of it is recognised, too.
inline constexpr std::string_view viscam_words = "colours as VisCAM";

/// One part per solid, welded exactly. The reader ignores the file's normals, because the order of the
/// corners counts. Colours become the face attribute COLOR_0, white where a triangle has none. Other
/// attribute bytes that are not zero become the face attribute "attribute". Warns (W-TRAILING) of bytes
/// after the triangles, and (W-COUNT) of a count that is left out.
[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);

/// Writes triangles as float32, with normals computed from the rounded corners. Text has one solid per part.
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::stl

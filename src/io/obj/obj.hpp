#pragma once
// Wavefront OBJ in steps: the statements of the file, the conversion to a scene, and the writer.

#include "io/codec.hpp"

#include <map>

namespace facetmill::io::obj {

/// A statement that applies to the following faces (and vertices).
struct Event {
    enum class Kind { object, group, material, smoothing, library };
    Kind kind;
    std::size_t face = 0, vertex = 0, line = 0; ///< the first face, vertex and line after the statement
    std::string text;
};

/// All statements of a file with resolved indices: from 0, in range, `none` if a corner lacks that index.
struct Statements {
    std::vector<Vec3> positions;
    std::vector<float> colours;             ///< three per position, or empty; NaN if the file gives none
    std::vector<float> uvs;                 ///< two each, as in the file: v starts at the bottom
    std::vector<float> normals;             ///< three each
    std::vector<Index> corners;             ///< [corners] positions
    std::vector<std::uint64_t> corner_keys; ///< uv << 32 | normal; empty if no corner has either
    std::vector<Index> face_offsets;
    std::vector<Index> line_points;             ///< [points of lines] positions
    std::vector<Index> line_offsets;            ///< [lines + 1] into line_points
    std::vector<Event> events;                  ///< in the order of the file
    std::map<std::string, std::size_t> skipped; ///< the count of each statement that cannot be kept
    std::size_t short_faces = 0;                ///< faces with fewer than three corners, left out
    std::size_t dangling = 0;                   ///< corners whose uv or normal is missing from the file

    std::size_t faces() const { return face_offsets.size() - 1; }
    std::size_t lines() const { return line_offsets.size() - 1; }
};

/// Whether colours of vertices count to 255 instead of 1. whole: all numbers of the colours are whole.
[[nodiscard]] constexpr bool count_to_255(double largest, bool whole) { return largest > (whole ? 1 : 2); }

/// Parses the text, in parallel over chunks of lines. Throws malformed (E-OBJ, E-NAN) with the line.
[[nodiscard]] Statements parse(const Input& input, const ReadSettings& settings);

/// Each `o` makes a part. Vertices that objects share are copied (note W-OBJECTS). In a file without `o`, `g`
/// makes parts instead, unless groups share vertices. Other groups lose their names (note W-GROUPS). If there
/// are several, the face attributes "group" and "smoothing_group" number them. `usemtl` makes materials and
/// primitives. Texture coordinates and normals make wedges. Lines
/// (`l`) make a separate part per object, with the colours of their vertices.
[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::obj

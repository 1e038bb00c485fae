#pragma once
// Wavefront OBJ, in pieces: the statements of the file, the scene that they make, and the way back.

#include "io/codec.hpp"

#include <map>

namespace facetmill::io::obj {

/// A statement that holds from a face (and a vertex) on.
struct Event {
    enum class Kind { object, group, material, smoothing, library };
    Kind kind;
    std::size_t face = 0, vertex = 0, line = 0; ///< the first ones behind it
    std::string text;
};

/// All statements of a file, indices resolved: from 0, in range, `none` where a corner has no such index.
struct Statements {
    std::vector<Vec3> positions;
    std::vector<float> colours;             ///< three a position, or empty; nan where the file gives none
    std::vector<float> uvs;                 ///< two each, as in the file: from the bottom
    std::vector<float> normals;             ///< three each
    std::vector<Index> corners;             ///< -> position
    std::vector<std::uint64_t> corner_keys; ///< uv << 32 | normal; empty when no corner has either
    std::vector<Index> face_offsets;
    std::vector<Index> line_points;             ///< -> position
    std::vector<Index> line_offsets;            ///< [lines + 1] into line_points
    std::vector<Event> events;                  ///< in the order of the file
    std::map<std::string, std::size_t> skipped; ///< how often each statement that cannot be kept was met
    std::size_t short_faces = 0;                ///< faces of fewer than three corners, left out
    std::size_t dangling = 0; ///< corners whose texture point or normal is not in the file: left without

    std::size_t faces() const { return face_offsets.size() - 1; }
    std::size_t lines() const { return line_offsets.size() - 1; }
};

/// Parses the text, in parallel over chunks of lines. Malformed (E-OBJ, E-NAN) with the line.
Statements parse(const Input& input, const ReadSettings& settings);

/// `o` makes parts, unless objects share vertices: then they stay one part, so that the surface stays whole,
/// with the face attribute "object". So does `g` in a file without `o`. Other groups lose their names
/// (W-GROUPS, a note): face attributes "group" and "smoothing_group" number them where there are several.
/// `usemtl` makes materials and primitives. Texture points and normals make wedges. Lines
/// (`l`) make parts of their own, one for each object, with the colours of their vertices.
Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);
Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::obj

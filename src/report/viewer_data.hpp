#pragma once
// A preview in the binary format that viewer.js reads.

#include "base/json.hpp"
#include "geometry/preview/preview.hpp"

namespace facetmill::report {

/// The consecutive faces of one material.
struct PackedGroup {
    PreviewPaint paint;
    std::size_t faces = 0;
};

struct PackedMesh {
    /// The members: vertices, triangles, loose (the first vertex without a triangle, where the line ends
    /// start, two per line), dots (the first single point), origin, size, normals, coloured, uv, and data
    /// (the bytes, gzipped, in base64). Coordinates are 16 bits within the box, normals 8 bits on an
    /// octahedron's net. Colours are the square roots of linear light in 8 bits, texture coordinates 16 bits
    /// within their range. Sequences are stored as differences in planes of bytes, which gzip compresses
    /// well.
    Json json;
    std::vector<PackedGroup> groups;
};

/// distances: [vertices] or empty; clamped to -most and most, in 15 bits. The same preview gives the same
/// bytes.
[[nodiscard]] PackedMesh packed(const Preview& preview, const std::vector<float>& distances, double most);

} // namespace facetmill::report

#pragma once
// A preview as the numbers and bytes that viewer.js reads.

#include "base/json.hpp"
#include "geometry/preview/preview.hpp"

namespace facetmill::report {

/// The faces of one paint, which follow each other.
struct PackedGroup {
    PreviewPaint paint;
    std::size_t faces = 0;
};

struct PackedMesh {
    /// vertices, triangles, loose (the first vertex that no triangle has: from there the ends of lines, two
    /// each), dots (the first single point), origin, size, normals, coloured, uv, and data: the bytes,
    /// gzipped, in base64. Coordinates are 16 bits over the box, normals 8 bits on an octahedron's net,
    /// colours the square roots of linear light in 8 bits, coordinates of textures 16 bits over their range.
    /// What follows each other is told as differences, in planes of bytes, which gzip likes.
    Json json;
    std::vector<PackedGroup> groups;
};

/// distances: [vertices] or empty; 15 bits between -most and most, beyond which they are cut off. The same
/// bytes for the same preview.
PackedMesh packed(const Preview& preview, const std::vector<float>& distances, double most);

} // namespace facetmill::report

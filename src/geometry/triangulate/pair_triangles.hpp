#pragma once
// Triangles into quads, by pairs.

#include "mesh/mesh.hpp"

namespace facetmill {

struct PairSettings {
    double cos_bend =
        0.984807753012208; ///< of the largest angle between the two halves' normals (10 degrees)
    double cos_corner =
        0.866025403784439; ///< of the smallest corner a quad may have, and its largest's supplement (30)
};

struct PairResult {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t quads = 0;     ///< made
    std::size_t triangles = 0; ///< left
};

/// Merges pairs of triangles that meet at an edge of exactly two faces, run along it opposite ways with the
/// same wedges and have the same primitive. The edge whose quad has corners nearest to right angles goes
/// first (ties: the lower edge); each triangle is used once. Vertices and wedges are kept; a quad has the
/// face attributes of its first triangle, and takes its place. Other faces pass as they are.
PairResult pair_triangles(const Mesh& mesh, const PairSettings& settings = {});

} // namespace facetmill

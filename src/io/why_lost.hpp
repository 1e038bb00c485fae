#pragma once
// Why a file that was read again is less sound than what was written.

#include "mesh/scene.hpp"

namespace facetmill::io {

/// What became of the vertices that faces use.
struct VertexChanges {
    std::size_t rounded = 0; ///< places fewer: rounding put points on others
    std::size_t merged = 0;  ///< vertices fewer beyond that: those at the same place are one in the file
    std::size_t added = 0;   ///< vertices more: the file has several where the scene has one
};

/// Compares by counts of vertices and of different places: part by part when both have as many parts, in the
/// parts' spaces, else in all, in world space. O(n log n).
VertexChanges vertex_changes(const Scene& before, const Scene& after);

} // namespace facetmill::io

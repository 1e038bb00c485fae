#pragma once
// Prefetches points for loops over faces, which mostly wait for the points of corners.

#include "base/math/simd.hpp"
#include "mesh/mesh.hpp"

namespace facetmill {

/// Prefetches the points of a triangle that follows soon after face f.
[[gnu::always_inline]] inline void fetch_points_soon(const Mesh& mesh, Index f) {
    constexpr std::size_t ahead = 48; // corners; 16 triangles cover the memory latency
    const std::size_t soon = mesh.face_begin(f) + ahead;
    if (soon + 3 > mesh.corner_count()) return;
    for (std::size_t c = soon; c < soon + 3; ++c) __builtin_prefetch(&mesh.point(static_cast<Index>(c)));
}

} // namespace facetmill

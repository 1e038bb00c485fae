#pragma once
// For loops over faces in order, most of whose time is waiting for the points of corners.

#include "base/math/simd.hpp"
#include "mesh/mesh.hpp"

namespace facetmill {

/// Asks the memory for the points of a triangle that comes soon after face f. Changes nothing.
[[gnu::always_inline]] inline void fetch_points_soon(const Mesh& mesh, Index f) {
    constexpr std::size_t ahead = 48; // corners: what 16 triangles take covers the wait
    const std::size_t soon = mesh.face_begin(f) + ahead;
    if (soon + 3 > mesh.corner_count()) return;
    for (std::size_t c = soon; c < soon + 3; ++c) __builtin_prefetch(&mesh.point(static_cast<Index>(c)));
}

} // namespace facetmill

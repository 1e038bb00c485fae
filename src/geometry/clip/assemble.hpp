#pragma once
// Puts one side of a cut together: kept faces, pieces, cap, attributes. For clip only.

#include "geometry/clip/cap.hpp"
#include "geometry/clip/clip.hpp"
#include "geometry/cut/cap_paint.hpp"

namespace facetmill {

struct ClippedSide {
    Mesh mesh;
    AttributeChanges changes;
};

/// side: 1 front, -1 back. Expects flat faces settled.
[[nodiscard]] ClippedSide assemble(const PlaneCut& cut, int side, const Pieces& pieces, const Cap& cap,
                                   const CapPaint& paint);

} // namespace facetmill

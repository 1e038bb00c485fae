#pragma once
// Assembles one side of a cut from kept faces, pieces, cap and attributes. Only clip uses it.

#include "geometry/clip/cap.hpp"
#include "geometry/clip/clip.hpp"
#include "geometry/cut/cap_paint.hpp"

namespace facetmill {

struct ClippedSide {
    Mesh mesh;
    AttributeChanges changes;
};

/// side: 1 front, -1 back. The cut must have decided about faces in the plane.
[[nodiscard]] ClippedSide assemble(const PlaneCut& cut, int side, const Pieces& pieces, const Cap& cap,
                                   const CapPaint& paint);

} // namespace facetmill

#pragma once
// A scene for resolving lengths and planes of a mesh in cells.

#include "stage/cell_flow.hpp"

namespace facetmill {

/// A scene of a single part without a transform, with the cells' box in the world.
[[nodiscard]] inline Scene world_outline(const CellFlow& flow) {
    Scene outline = flow.outline();
    Part& part = outline.parts.front();
    part.transform = {};
    part.mesh.positions.clear();
    if (!flow.box.empty()) part.mesh.positions = {flow.box.min, flow.box.max};
    return outline;
}

} // namespace facetmill

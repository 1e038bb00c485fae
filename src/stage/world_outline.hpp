#pragma once
// Where lengths and planes of a mesh in cells are resolved.

#include "stage/cell_flow.hpp"

namespace facetmill {

/// A scene of a part without a transform whose box is that of the cells in the world.
inline Scene world_outline(const CellFlow& flow) {
    Scene outline = flow.outline();
    Part& part = outline.parts.front();
    part.transform = {};
    part.mesh.positions.clear();
    if (!flow.box.empty()) part.mesh.positions = {flow.box.min, flow.box.max};
    return outline;
}

} // namespace facetmill

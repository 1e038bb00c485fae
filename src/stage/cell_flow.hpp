#pragma once
// A scene larger than memory in the first stages of a run. It is stored as cells on disk, until a stage has
// made it small enough, or to the end.

#include "cells/partition/partition.hpp"
#include "mesh/scene.hpp"
#include "stage/surface_loss.hpp"

namespace facetmill {

struct CellFlow {
    cells::CellResources means;
    std::unique_ptr<cells::Partition> partition; ///< set after a load; null once the scene is in memory
    std::string part;                            ///< the name of the only part
    Transform transform;                         ///< from the cells' space to the world
    Box box;                                     ///< the part's bounding box, in the world
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    std::optional<Scene> scene; ///< the scene, once it is back in memory
    /// The input of the stage that created the scene, for its surface check.
    std::optional<PartSurface> surface;

    Box bounds() const { return scene ? scene->bounds() : box; }

    /// A scene of a single part with the corners of the cells' box, to resolve lengths.
    Scene outline() const {
        Scene outline;
        outline.unit = unit;
        outline.up = up;
        Part& only = outline.parts.emplace_back();
        only.name = part;
        only.transform = transform;
        const Box own = partition ? partition->source().contents().bounds : Box{};
        if (!own.empty()) only.mesh.positions = {own.min, own.max};
        return outline;
    }
};

} // namespace facetmill

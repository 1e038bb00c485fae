#pragma once
// A scene that is larger than memory on its way through the first stages of a run: cells on disk, until a
// stage has made it small, or to the end.

#include "cells/partition/partition.hpp"
#include "mesh/scene.hpp"
#include "stage/surface_loss.hpp"

namespace facetmill {

struct CellFlow {
    cells::CellResources means;
    std::unique_ptr<cells::Partition> partition; ///< after a load; gone when there is a scene
    std::string part;                            ///< the name of the only part
    Transform transform;                         ///< from the cells' own space to the world
    Box box;                                     ///< around the part, in the world
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    std::optional<Scene> scene; ///< in memory again
    /// Of a stage that made the scene, and is to keep the surface: what it was given.
    std::optional<PartSurface> surface;

    Box bounds() const { return scene ? scene->bounds() : box; }

    /// A scene of one part with the corners of the cells' box, where lengths are resolved.
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

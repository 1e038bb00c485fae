#pragma once
// A scene that is larger than memory on its way through the first stages of a run: cells on disk, until a
// stage has made it small.

#include "cells/partition.hpp"
#include "mesh/scene.hpp"

namespace facetmill {

struct CellFlow {
    cells::Means means;
    std::unique_ptr<cells::Partition> partition; ///< after a load; gone when there is a scene
    std::string part;                            ///< the name of the only part
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    std::optional<Scene> scene; ///< in memory again

    Box bounds() const {
        return scene ? scene->bounds() : partition ? partition->source().contents().bounds : Box{};
    }
};

} // namespace facetmill

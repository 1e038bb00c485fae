#pragma once
// The faces of the walls of a crop, and their attributes. For crop only.

#include "geometry/crop/walls.hpp"
#include "geometry/crop/wall_panel.hpp"

namespace facetmill {

struct WallFaces {
    std::span<const WallPanel> panels; ///< filled; their points are vertices of the mesh
    const Walls& walls;
    const WallSettings& settings;
    Index first_added = 0; ///< the vertex of the first point that the panels added; the others follow
};

/// Appends the walls to the kept faces, panel by panel.
AttributeChanges append_walls(Mesh& mesh, const WallFaces& faces);

} // namespace facetmill

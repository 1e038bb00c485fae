#pragma once
// The help and manual texts of extrude.

namespace facetmill::help::extrude {

inline constexpr const char* about =
    R"(Makes a solid of a terrain: straight down or up to a level, or by a length.)";

inline constexpr const char* details =
    R"(The surface is one side of the solid.
The other side is straight above or below: flat at a level, or a copy at a distance.
Walls along the boundary edges close the solid.
The solid is closed and oriented, whichever way the surface looks.
Vertices do not move sideways, unlike in thicken, which moves along the normals.

No vertical line may meet the surface twice, so surfaces that overhang are refused (E-EXTRUDE).
Vertical faces are allowed.
A level must not be between the lowest and the highest vertex.
Where the boundary is exactly at the level, the solid has no wall.
Sheets that meet only at a vertex, or at an edge with more than two faces, become separate solids.

Both sides keep their attributes, and the other side gets reversed normals, or its own normal if it is flat.
Walls copy the attributes of their edge and get their own normals.
The axis is the up axis of the scene, or z if the up axis is unknown.)";

} // namespace facetmill::help::extrude

#pragma once
// The help and manual texts of extrude.

namespace facetmill::help::extrude {

inline constexpr const char* about =
    R"(Extrudes a terrain up or down into a solid, to a level or by a length.)";

inline constexpr const char* details =
    R"(The surface is one side of the solid.
The other side is straight above or below: flat at a level, or a copy at a distance.
Walls along the boundary edges close the solid.
The solid is closed and oriented, whether the surface faces up or down.
Vertices move only along the axis. In thicken, they move along the normals.

Surfaces that overhang are refused (E-EXTRUDE), because a vertical line may meet the surface only once.
Vertical faces are allowed.
A level must not be between the lowest and the highest vertex.
Where the boundary is exactly at the level, the solid has no wall.
Sheets that meet only at a vertex, or at an edge with more than two faces, become separate solids.

Both sides keep the attributes of the surface.
The other side gets reversed normals, or the normal of its plane if it is flat.
Walls copy the attributes of their edge and get their own normals.
The axis is the up axis of the scene, or z if the up axis is unknown.)";

} // namespace facetmill::help::extrude

#pragma once
// The help and manual texts of transform.

namespace facetmill::help::transform {

inline constexpr const char* about = R"(Moves, rotates and scales parts. Converts units and the up axis.)";

inline constexpr const char* details =
    R"(The operations always run in this order: unit and up (for the whole scene), scale, rotate, matrix,
orient_for, fit, translate, centre, ground.
The order of the options does not matter.
All operations work in world space.
They change the nodes of the parts, not the meshes, unless bake is on.
With orient_for: printing, all parts turn together so that as little area as possible overhangs.
If overhangs differ by less than 1/1000 of the surface area, the direction with the lowest height is used.
The stage tries the current direction, faces of the convex hull, large flat areas and fixed directions.
It refines the best directions in steps from 8 degrees down to half a degree.
The report gives the overhanging area and the height before and after the turn.
Mirrored faces keep their front side, as glTF requires.
The ground is at 0 along the up axis, or along +Z if the up axis is unknown.
The bounding box of the parts covers what viewers draw. Skinned and morphed parts count in their default
pose, and animated nodes at their largest scale. Hidden parts and lower levels of detail do not count.
A skinned part is moved in its bind pose together with its skeleton, and keeps its skin.
Cameras, lights, empty nodes and animations of a glTF file move with its parts, if all of its parts move.)";

} // namespace facetmill::help::transform

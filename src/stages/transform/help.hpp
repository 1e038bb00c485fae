#pragma once
// The help and manual texts of transform.

namespace facetmill::help::transform {

inline constexpr const char* about = R"(Moves, rotates and scales parts. Converts units and the up axis.)";

inline constexpr const char* details =
    R"(The operations always run in this order: unit and up (for the whole scene), crs, scale, rotate, matrix,
orient_for, fit, translate, centre, ground, place.
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
place and crs make the scene geocentric (ECEF, EPSG:4978), in metres. They set its up axis to z.
Globe viewers such as CesiumJS then show its tileset in the right place.
place moves the whole scene: its origin to the given place, and its y axis along the heading.
crs converts every vertex from projected coordinates, with an error below a millimetre, and turns normals.
ETRS89 is treated as WGS84. They differ by less than a metre.
Heights are above the ellipsoid.
If your heights are above the geoid, set geoid to its height above the ellipsoid.
Coordinates outside the system, such as degrees, are refused (E-CRS).
Cameras, lights, empty nodes and animations of a glTF file move with its parts, if all of its parts move.)";

} // namespace facetmill::help::transform

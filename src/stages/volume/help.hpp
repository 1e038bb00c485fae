#pragma once
// The help and manual texts of volume.

namespace facetmill::help::volume {

inline constexpr const char* about =
    R"(Measures cut and fill: the volume between a surface and a level or another surface.)";

inline constexpr const char* details =
    R"(The stage looks along the up axis and compares the scene with a level, or with the surface of another file.
In the report, `above` has the volume where the scene is higher, and `below` where it is lower.
If the scene is the ground and the other surface is the design, these are the cut and the fill.
Each has a projected area, a mean depth and a largest depth.

With a footprint, only the inside of the polygon counts.
Without a footprint, the whole scene counts.
Areas where a surface is missing are not compared (W-VOLUME-MISSING).
The report gives them as missing_area and missing_in_other.

Both surfaces consist of flat triangles, so the volume between them is exact, up to the rounding of
64-bit floats.
The stage overlays all triangles and the footprint, and sums the volumes of the pieces.
Exact predicates decide which triangles overlap.

A terrain may be open, and its orientation does not matter.
A surface may overhang if its faces are consistently oriented.
Its volumes are then the material above and the air below the reference.
Sheets above each other are refused (E-VOLUME).
Slivers of up to a millionth of the area may overlap, as between the tiles of a terrain.
A closed solid has a volume above and below a level, but no areas.
To measure a whole solid, use measure.

The scene passes on unchanged.)";

} // namespace facetmill::help::volume

#pragma once
// The help and manual texts of volume.

namespace facetmill::help::volume {

inline constexpr const char* about =
    R"(Measures cut and fill: the volume between a surface and a level or another surface.)";

inline constexpr const char* details =
    R"(The stage looks along the up axis and compares the scene with a level, or with the surface of another file.
The result above is the volume where the scene is higher: the cut, if the scene is the ground and the
other surface is the design.
The result below is the volume where the scene is lower: the fill.
Each has an area in the plane, a mean depth and a largest depth.

With a footprint, only the inside of the polygon counts.
Without a footprint, the whole scene counts.
Where one of the surfaces is missing, nothing is compared.
The results missing_area and missing_in_other give these areas (W-VOLUME-MISSING).

Both surfaces consist of flat triangles, so the volume between them is exact, up to the rounding of
64-bit floats.
The stage sums the overlay of all triangles and of the footprint.
Exact signs decide which triangles overlap.

A terrain may be open, and its orientation does not matter.
A surface may overhang if its faces are consistently oriented.
Its volumes are then the material above and the air below the reference.
Sheets above each other are refused (E-VOLUME).
They may overlap by slivers of up to a millionth of their area, as the tiles of a terrain do.
A closed solid has a volume above and below a level, but no areas.
To measure a whole solid, use measure.

The scene passes on unchanged.)";

} // namespace facetmill::help::volume

#pragma once
// The help and manual texts of nest.

namespace facetmill::help::nest {

inline constexpr const char* about = R"(Arranges parts on the plates of a printer.)";

inline constexpr const char* details =
    R"(Parts do not overlap, and keep `spacing` between them.
Each selected part moves as a whole: its bounding box gets a place on a plate, and its lowest point
is put on the ground.
The first plate begins at the origin.
Further plates lie to its right, along +X, each a fifth of its width from the one before.
Larger parts are placed first, each as far to the front as possible.
Parts turn by 90 degrees about the up axis if they fit better, unless turn is off.
The ground is perpendicular to the up axis, or to +Z if the up axis is unknown.
Only the nodes of the parts change, so 3MF files get a build item for each part.

If a part is larger than the plate, or more plates are needed than allowed, the stage fails and names
all parts without a place (E-NEST).
Use transform: {orient_for: printing} for each part before, and tile: {fit: ...} to cut large parts.)";

} // namespace facetmill::help::nest

#pragma once
// The help and manual texts of nest.

namespace facetmill::help::nest {

inline constexpr const char* about = R"(Arranges parts on the plates of a printer.)";

inline constexpr const char* details =
    R"(Parts do not overlap, and have at least `spacing` between them.
Each selected part moves as a whole: its bounding box gets a place on a plate, and its lowest point
is put on the ground.
The first plate begins at the origin.
Further plates lie to its right, along +X, with gaps of a fifth of the plate's width.
Larger parts are placed first, each as far to the front as possible.
Parts turn by 90 degrees about the up axis if they fit better, unless turn is off.
The ground is perpendicular to the up axis, or to +Z if the up axis is unknown.
Only the nodes of the parts change, so 3MF files get a build item for each part.

The stage fails if a part is larger than the plate, or if more plates are needed than allowed.
The error names the parts without a place (E-NEST).
Before nest, turn each part with transform: {orient_for: printing}, and cut large parts with
tile: {fit: ...}.)";

} // namespace facetmill::help::nest

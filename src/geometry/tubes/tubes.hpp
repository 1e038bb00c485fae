#pragma once
// Turns lines into tubes: closed solids with a round section. The section is carried along without turning
// about the line, after R. L. Bishop, "There is more than one way to frame a curve" (1975).

#include "mesh/lines.hpp"

#include <cstddef>

namespace facetmill {

struct TubesSettings {
    double thickness = 1; ///< the diameter, above zero
    int sides = 8;        ///< sides of the section, 3 or more
};

struct TubesResult {
    Mesh mesh; ///< has no attributes
    std::vector<Index> face_material;
    std::size_t tubes = 0;    ///< number of closed solids
    std::size_t segments = 0; ///< number of lines along the tubes
    std::size_t skipped = 0;  ///< lines without length, or duplicates
    std::size_t sharp =
        0; ///< corners too sharp, or with sides too short, for a mitre; the tube overlaps at these
};

/// Consecutive lines with the same material become a tube. It continues where exactly two lines meet, and
/// has a flat end where a single line or more than two lines end. At a corner both sides run to the plane
/// that halves the angle (a mitre). If a mitre needs more than a thickness, or more than half of a side, the
/// section turns about the corner instead. The steps are at most 22.5 degrees. The section is carried along
/// without turning about the line. A closed tube distributes the remaining turn evenly, in triangles. Each
/// tube is closed and oriented outward. Tubes intersect if they meet, cross, or are thicker than the
/// distance of their lines. O(n log n) in the lines; requires finite points.
[[nodiscard]] TubesResult tubes(const Lines& lines, const TubesSettings& settings);

/// A closed cylinder with flat ends. The corners of its section are at the radius.
[[nodiscard]] Mesh rod(const Vec3& from, const Vec3& to, double radius, int sides);

} // namespace facetmill

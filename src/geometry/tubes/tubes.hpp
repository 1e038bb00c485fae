#pragma once
// Lines that become tubes: closed solids of a round section. The section is carried along without turning
// about the line, after R. L. Bishop, "There is more than one way to frame a curve" (1975).

#include "mesh/lines.hpp"

#include <cstddef>

namespace facetmill {

struct TubesSettings {
    double thickness = 1; ///< the diameter, above zero
    int sides = 8;        ///< of the section, 3 or more
};

struct TubesResult {
    Mesh mesh; ///< without attributes
    std::vector<Index> face_material;
    std::size_t tubes = 0;    ///< closed solids
    std::size_t segments = 0; ///< lines that they run along
    std::size_t skipped = 0;  ///< lines without length, or that are there twice
    std::size_t sharp =
        0; ///< corners too sharp, or with too short sides, for a mitre; the tube overlaps there
};

/// Lines that follow one another and have one material become one tube: it goes on where exactly two lines
/// meet, and ends, flat, where one or more than two do. At a corner both sides run to the plane that halves
/// the angle (a mitre). Where that takes more than a thickness, or more than half of a side, the section
/// turns about the corner instead, in steps of at most 22.5 degrees. The section is carried along without
/// turning about the line; a tube that closes takes up what is left evenly, in triangles. Each tube is closed
/// and oriented outward. Tubes that meet, cross or are thicker than their lines are apart go through one
/// another. O(n log n) in the lines; requires finite points.
TubesResult tubes(const Lines& lines, const TubesSettings& settings);

} // namespace facetmill

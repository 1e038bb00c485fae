#pragma once
// Finds the direction in which to print a model.

#include "mesh/surface.hpp"

namespace facetmill {

struct PrintDirectionSettings {
    /// In radians, above zero and below a right angle. A face overhangs if it looks down and its slope
    /// against the plate is below this angle.
    double overhang_angle = 0.78539816339744830962;
};

/// A direction that points up, with the resulting overhang and height of the model.
struct PrintDirection {
    Vec3 up{0, 0, 1};    ///< of unit length
    double overhang = 0; ///< the area of overhanging faces, except faces that lie on the plate
    double height = 0;
};

struct PrintDirectionResult {
    PrintDirection before, after;
};

/// Among the directions with the least overhang (up to 1/1000 of the surface's area), returns the one with
/// the least height. If heights are equal up to 1e-9 of the size, returns the direction nearest to `up`. The
/// candidates are `up`, the directions in which a face of the convex hull lies on the plate, the normals of
/// the surface with the largest areas, and 188 fixed directions. The four with the least overhang, and then
/// the eight lowest, are turned in steps from 8 degrees down to half a degree while this improves them. Faces
/// lie on the plate if their corners are at most four 32-bit steps above it. Faces overhang only if their
/// slope is below the limit by more than 1e-6, so rounding does not decide for faces at the limit. The
/// surface needs a face with area; up must have unit length. Parallel, in about 1000 passes over the surface;
/// the same for any number of threads.
[[nodiscard]] PrintDirectionResult find_print_direction(const Surface& surface, const Vec3& up,
                                                        const PrintDirectionSettings& settings = {});

/// The rotation by the smallest angle that turns one unit vector into another.
[[nodiscard]] Transform turn_onto(const Vec3& from, const Vec3& to);

} // namespace facetmill

#pragma once
// The options of transform and their conversion to a matrix.

#include "stage/stage.hpp"

namespace facetmill::transform_stage {

struct TransformRotation {
    Vec3 axis{0, 0, 1};
    Angle angle;
};

/// A place on the globe for the scene's origin.
struct GlobePlace {
    Angle lat, lon, heading;
    Length height;
};

struct TransformOptions {
    /// The fixed point of scale, rotate and fit.
    enum class Pivot { origin, centre };
    /// The purpose that parts are turned for.
    enum class Purpose { none, printing };

    std::vector<Length> translate, fit;
    std::optional<TransformRotation> rotate;
    std::vector<double> scale, matrix;
    Pivot pivot = Pivot::origin;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    Purpose orient_for = Purpose::none;
    Angle overhang_angle = Angle::degrees(45);
    std::optional<GlobePlace> place;
    std::string crs;
    std::optional<Length> geoid;
    enum class Target { ecef };
    Target to = Target::ecef;
    bool shrink_only = false, centre = false, ground = false, bake = false;
};

void declare_transform(Declare<TransformOptions>& d);
/// Checks counts of numbers and singular matrices, which the declaration cannot express.
void verify_transform(const TransformOptions& o, const Value& given, Problems& problems);

/// The transform that scales, then rotates, about the origin.
[[nodiscard]] Transform spin_of(const TransformOptions& o);
/// The `matrix` option; the identity by default.
[[nodiscard]] Transform matrix_of(const TransformOptions& o);

} // namespace facetmill::transform_stage

#pragma once
// The options of transform, and what they come to.

#include "stage/stage.hpp"

namespace facetmill::transform_stage {

struct TransformRotation {
    Vec3 axis{0, 0, 1};
    Angle angle;
};

struct TransformOptions {
    /// The point that scale, rotate and fit leave where it is.
    enum class Pivot { origin, centre };

    std::vector<Length> translate, fit;
    std::optional<TransformRotation> rotate;
    std::vector<double> scale, matrix;
    Pivot pivot = Pivot::origin;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    bool centre = false, ground = false, bake = false;
};

void declare_transform(Declare<TransformOptions>& d);
/// What the declaration cannot say: how many numbers there must be, and matrices that flatten.
void verify_transform(const TransformOptions& o, const Value& given, Problems& problems);

/// scale, then rotate, about the origin.
Transform spin_of(const TransformOptions& o);
/// matrix, or the identity when it is not given.
Transform matrix_of(const TransformOptions& o);

} // namespace facetmill::transform_stage

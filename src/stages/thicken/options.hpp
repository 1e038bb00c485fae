#pragma once
// The options of thicken and their conversion to settings.

#include "geometry/thicken/thicken.hpp"
#include "stage/stage.hpp"

namespace facetmill::thicken_stage {

struct ThickenOptions {
    enum class Mode { surface, edges, boundary_edges };
    enum class SelfIntersections { ignore, count, resolve };

    Length thickness;
    ThickenSide side = ThickenSide::inward;
    Mode mode = Mode::surface;
    double miter_limit = 3;
    std::int64_t sides = 8;
    SelfIntersections self_intersections = SelfIntersections::count;

    bool looks() const { return self_intersections != SelfIntersections::ignore; }
};

void declare_thicken(Declare<ThickenOptions>& d);

} // namespace facetmill::thicken_stage

#pragma once
// The options of thicken and their conversion to settings.

#include "geometry/thicken/thicken.hpp"
#include "stage/stage.hpp"

namespace facetmill::thicken_stage {

struct DrainOptions {
    Length diameter;
    std::int64_t count = 1;
    bool vent = false;
};

struct ThickenOptions {
    enum class Mode { surface, edges, boundary_edges };
    enum class SelfIntersections { ignore, count, resolve };

    Length thickness;
    ThickenSide side = ThickenSide::inward;
    Mode mode = Mode::surface;
    double miter_limit = 3;
    std::int64_t sides = 8;
    SelfIntersections self_intersections = SelfIntersections::count;

    std::optional<DrainOptions> drain;

    bool looks() const { return self_intersections != SelfIntersections::ignore; }
};

void declare_thicken(Declare<ThickenOptions>& d);
/// Checks that drain is used with surfaces.
void verify_thicken(const ThickenOptions& o, const Value& given, Problems& problems);

} // namespace facetmill::thicken_stage

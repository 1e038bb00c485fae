#pragma once
// The report and warnings of thicken.

#include "geometry/drain/drain.hpp"
#include "stages/thicken/options.hpp"

#include <variant>

namespace facetmill::thicken_stage {

/// The result for a surface.
struct ThickenedSurface {
    std::string part;
    ThickenResult result;
    bool has_faces = true;
    bool looked = false;                ///< checked for self-intersections
    Unit unit = Unit::unknown;          ///< the scene's unit
    std::optional<DrainResult> drained; ///< without its mesh
};
/// The result for edges that became cylinders.
struct ThickenedEdges {
    std::string part;
    std::size_t cylinders = 0, without_length = 0;
};
using ThickenedPart = std::variant<ThickenedSurface, ThickenedEdges>;

struct ThickenReport {
    std::vector<ThickenedPart> parts;
};
void declare_thicken_report(DeclareFields<ThickenReport>& d);

/// The thickness in world space, and the scene's unit.
struct WallAskedFor {
    double thickness = 0;
    Unit unit = Unit::unknown;
};

/// Warns about cavities without holes.
void warn_of_cavities(const Part& part, const DrainResult& drained, Context& context);
/// Warns if the solid is open, thinner than requested, or intersects itself.
void warn_of_walls(const Part& part, const ThickenResult& r, const WallAskedFor& wall,
                   const ThickenOptions& o, Context& context);

} // namespace facetmill::thicken_stage

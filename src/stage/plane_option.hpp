#pragma once
// The option `plane` of clip and section: a plane as users write it, which waits for a scene to become one.

#include "geometry/plane.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// A plane as written, in one of three forms:
///   {normal: [0, 0, 1], through: centre}           through: centre, 30%, or a point [x, y, z]
///   {coefficients: [A, B, C, D]}                   A x + B y + C z + D = 0
///   z=0.2, z=2mm, z=50%                            across an axis, at a height or a percentage of the extent
struct PlaneOption {
    /// A point, or a percentage of the extent along the normal (centre: 50%).
    struct Through {
        std::optional<Vec3> point;
        double percent = 50;
    };
    std::optional<Vec3> normal;
    Through through;
    std::vector<double> coefficients;
    int axis = -1; ///< of the short form
    Length height; ///< ... and its place; a percentage is of the extent along the axis
};

void declare_plane(Declare<PlaneOption>& d);

template <>
struct OptionType<PlaneOption::Through> {
    static constexpr const char* name = "point";
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, PlaneOption::Through& out, Problems& problems);
    static std::string print(const PlaneOption::Through& through);
    static Json schema();
    static std::optional<double> magnitude(const PlaneOption::Through&) { return {}; }
};

/// The plane in world space. Percentages run from the lowest to the highest of the bounds along the normal.
/// Throws usage (E-PLANE, E-UNIT).
Plane resolve(const PlaneOption& option, const Scene& scene, const Box& bounds, Context& context);

} // namespace facetmill

#pragma once
// A footprint as users write it: a file, WKT, or inline rings. And the axis to look along.

#include "geometry/polygon/footprint.hpp"
#include "io/footprint/footprint.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace facetmill {

struct FootprintOption {
    std::string path; ///< the file; empty: use the rings
    io::FootprintRings rings;
};

template <>
struct OptionType<FootprintOption> {
    static constexpr OptionKind kind = OptionKind::footprint;
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, FootprintOption& out, Problems& problems);
    static std::string print(const FootprintOption& value) { return value.path; }
    static Json schema();
    static std::optional<double> magnitude(const FootprintOption&) { return {}; }
};

/// Checks an inline footprint before the run, and adds the errors of Footprint at the mark.
void verify_footprint(const FootprintOption& option, const Value& value, std::string_view stage,
                      Problems& problems);

/// The footprint, in a scene of this unit. A file is listed in the record as an input. Warns as
/// io::read_footprint, and (W-UNITS) if only the file or only the scene has a unit. Throws as
/// io::read_footprint and Footprint.
[[nodiscard]] Footprint resolve_footprint(const FootprintOption& option, Unit unit, Context& context);

/// The axis to look along.
enum class ViewAxis { up, x, y, z };

/// Declares `axis`.
template <class S>
void declare_view_axis(Declare<S>& d, ViewAxis S::*axis) {
    d.template choice<ViewAxis>("axis", axis,
                                {{"up", ViewAxis::up, "the scene's up axis, or z if it is unknown"},
                                 {"x", ViewAxis::x, "the footprint is in y and z"},
                                 {"y", ViewAxis::y, "the footprint is in x and z"},
                                 {"z", ViewAxis::z, "the footprint is in x and y"}},
                                "The axis to look along.");
}
/// The coordinate along the axis: 0 x, 1 y, 2 z.
[[nodiscard]] std::size_t axis_of(ViewAxis axis, UpAxis up);

/// The bounds of points in the plane of a footprint.
struct FlatBounds {
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    void add(double u, double v);
    void add(const FlatBounds& b);
    std::string text() const;
    /// Whether the coordinates may be longitudes and latitudes.
    bool may_be_degrees() const;
    double longest_side() const { return std::max(high[0] - low[0], high[1] - low[1]); }
};
[[nodiscard]] FlatBounds bounds_of(const Footprint& footprint);
/// The bounds of a part in the world, seen along the axis.
[[nodiscard]] FlatBounds bounds_of(const Part& part, std::size_t axis);

/// The hint if a footprint and a mesh do not overlap. If the footprint seems to be in degrees: convert it.
[[nodiscard]] const char* hint_for_missed(const FlatBounds& footprint, const FlatBounds& mesh);

} // namespace facetmill

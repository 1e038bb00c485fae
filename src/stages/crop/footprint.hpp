#pragma once
// A footprint as users write it: a file, WKT, or inline rings.

#include "geometry/polygon/footprint.hpp"
#include "io/footprint/footprint.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

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

} // namespace facetmill

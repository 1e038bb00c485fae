#pragma once
// A footprint as users write it: a file, WKT, or rings in place.

#include "geometry/polygon/footprint.hpp"
#include "io/footprint/footprint.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

namespace facetmill {

struct FootprintOption {
    std::string path; ///< of a file; empty: the rings
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

/// A footprint written in place is checked before anything runs: adds what Footprint refuses, at the mark.
void verify_footprint(const FootprintOption& option, const Value& value, std::string_view stage,
                      Problems& problems);

/// The footprint, read from its file, which the record lists, when it is one. Throws what io::read_footprint
/// and Footprint throw.
Footprint resolve_footprint(const FootprintOption& option, Context& context);

} // namespace facetmill

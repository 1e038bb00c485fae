#pragma once
// The box option, and the planes that bound it.

#include "mesh/plane.hpp"
#include "options/declaration.hpp"

#include <array>

namespace facetmill {

/// The six numbers of a box aligned with the axes.
struct BoxCorners {
    std::array<double, 6> numbers{};
};

template <>
struct OptionType<BoxCorners> {
    static constexpr OptionKind kind = OptionKind::corners;
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, BoxCorners& out, Problems& problems);
    static std::string print(const BoxCorners& value);
    static Json schema();
    static std::optional<double> magnitude(const BoxCorners&) { return {}; }
};

/// A box by two corners, or by centre and size; optionally rotated about its centre.
struct BoxOption {
    std::optional<Vec3> min, max, centre, size;
    Vec3 axis{0, 0, 1};
    Angle angle;
};

/// Declares the group and its short form, [x, y, z, X, Y, Z].
void declare_box(Declare<BoxOption>& d);

/// Adds E-BOX for an invalid box: missing corners or sizes, no volume, a zero axis.
void verify_box(const BoxOption& box, const Mark& where, Problems& problems);

/// The six face planes of the box, facing inwards, so that the box is in front of all planes. Without a
/// rotation they are axis-aligned and use the given numbers exactly.
[[nodiscard]] std::vector<Plane> planes_of(const BoxOption& box);

} // namespace facetmill

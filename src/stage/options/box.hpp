#pragma once
// A box as users write it, and the planes that bound it.

#include "mesh/plane.hpp"
#include "options/declaration.hpp"

#include <array>

namespace facetmill {

/// The six numbers of a box across the axes.
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

/// A box by two corners, or by centre and size; either turned about its centre on request.
struct BoxOption {
    std::optional<Vec3> min, max, centre, size;
    Vec3 axis{0, 0, 1};
    Angle angle;
};

/// Declares the group and its short form, [x, y, z, X, Y, Z].
void declare_box(Declare<BoxOption>& d);

/// Adds E-BOX for what is no box: corners or sizes missing, nothing between them, a zero axis.
void verify_box(const BoxOption& box, const Mark& where, Problems& problems);

/// Its six faces, looking inwards: the body is in front of all of them. Without an angle they are across the
/// axes, through the very numbers given.
std::vector<Plane> planes_of(const BoxOption& box);

} // namespace facetmill

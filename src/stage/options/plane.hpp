#pragma once
// The plane option, and the resulting plane for a scene.

#include "mesh/plane.hpp"
#include "options/declaration.hpp"
#include "stage/context.hpp"

#include <array>

namespace facetmill {

/// The position of a plane: a point, the centre of the scene's box, or a percentage of the scene's extent
/// along the normal. The short form gives a length on the normal's axis.
struct PlanePlace {
    enum class Kind { point, centre, extent, level };
    Kind kind = Kind::point;
    Vec3 point;
    double percent = 0;
    Length level;
};

template <>
struct OptionType<PlanePlace> {
    static constexpr OptionKind kind = OptionKind::point;
    static constexpr Dimension dimension = Dimension::length;
    static bool parse(const Value& value, PlanePlace& out, Problems& problems);
    static std::string print(const PlanePlace& value);
    static Json schema();
    static std::optional<double> magnitude(const PlanePlace&) { return {}; }
};

/// The coefficients of A x + B y + C z + D = 0.
struct PlaneCoefficients {
    std::array<double, 4> abcd{};
};

template <>
struct OptionType<PlaneCoefficients> {
    static constexpr OptionKind kind = OptionKind::coefficients;
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, PlaneCoefficients& out, Problems& problems);
    static std::string print(const PlaneCoefficients& value);
    static Json schema();
    static std::optional<double> magnitude(const PlaneCoefficients&) { return {}; }
};

/// A plane by normal and point, by coefficients, or in a short form.
struct PlaneOption {
    std::optional<Vec3> normal;
    PlanePlace through;
    std::optional<PlaneCoefficients> coefficients;
};

/// Declares the group and its short forms: "z=0.2", "x=10%", "y=2mm", "z=centre" and [A, B, C, D].
void declare_plane(Declare<PlaneOption>& d);

template <>
struct OptionType<PlaneOption> {
    static constexpr OptionKind kind = OptionKind::plane;
    static constexpr Dimension dimension = Dimension::none;
    static bool parse(const Value& value, PlaneOption& out, Problems& problems);
    static std::string print(const PlaneOption&) { return {}; }
    static Json schema();
    static std::optional<double> magnitude(const PlaneOption&) { return {}; }
};

/// The length in the short form of a plane, "5mm" in "z=5mm", with its position in the text. None for other
/// values, percentages and centre.
[[nodiscard]] std::optional<Value> length_in_plane(const Value& value);

/// Adds E-PLANE for an invalid plane: no value, or a zero normal.
void verify_plane(const PlaneOption& plane, const Mark& where, Problems& problems);

/// The plane in world space. With a part, it is in that part's space, and uses its centre and extent.
/// Records lengths under the option's name. Throws a usage error (E-UNIT, E-PLANE).
[[nodiscard]] Plane resolve_plane(const PlaneOption& plane, const Scene& scene, Context& context,
                                  std::string_view option, const Part* local = nullptr);

} // namespace facetmill

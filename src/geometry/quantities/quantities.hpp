#pragma once
// Quantities of the faces or vertices of a mesh that follow from its shape. The stage measure keeps them as
// attributes, and pictures show them.

#include "geometry/spatial/face_tree.hpp"
#include "mesh/scene.hpp"

#include <string_view>

namespace facetmill {

/// The dimension of numbers: a power of a length, an angle in degrees, or a pure number.
enum class Measure { number, degrees, length, area, per_length, per_area };

/// A quantity: a row of a table. Properties of faces (min_angle, wall_thickness) come from the rows of
/// geometry/inspect, so that they have the same names and values.
struct Quantity {
    std::string_view name; ///< name for users, and of the attribute
    Domain domain = Domain::face;
    Measure measure = Measure::number;
    std::string_view help;
    std::string_view missing{};                  ///< where values are missing, in words: "on boundaries"
    std::vector<std::string_view> other_names{}; ///< synonyms
    bool is_signed = false;                      ///< the sign has a meaning
    bool compares = false;                       ///< the quantity compares with another surface
    std::vector<double> (*of)(const Quantity&, const Mesh& world, const FaceTree* other) = nullptr;
};

/// All quantities, in the order of the help.
const std::vector<Quantity>& quantities();
[[nodiscard]] std::vector<std::string> quantity_names();
/// The names and synonyms of all quantities, to suggest the nearest name.
[[nodiscard]] std::vector<std::string> quantity_words();
/// The quantity with this name, or null.
[[nodiscard]] const Quantity* quantity_named(std::string_view name);
/// The quantity with this name or synonym, or null.
[[nodiscard]] const Quantity* quantity_called(std::string_view word);

/// The unit as text: "mm", "1/mm^2", "degrees". If the unit is unknown, "scene units" or similar; empty for
/// pure numbers.
[[nodiscard]] std::string unit_of(const Quantity& quantity, Unit unit);

/// The values of the part's faces or vertices, in world space and scene units. Missing values are NaN.
/// other: the surface, in world space, for quantities that compare. O(n log n); the result does not depend
/// on the number of threads.
[[nodiscard]] std::vector<double> values_of(const Quantity& quantity, const Part& part,
                                            const FaceTree* other = nullptr);

/// Stores the values as an attribute, and replaces any attribute with the same name. Missing values become
/// `none`, if given.
void give_attribute(Part& part, const Quantity& quantity, std::vector<double> values,
                    std::optional<double> none = {});

} // namespace facetmill

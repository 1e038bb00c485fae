#pragma once
// Numbers that every face, or every vertex, of a mesh has by its shape. The stage measure keeps them as
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
    std::string_view name; ///< as users write it, and of the attribute
    Domain domain = Domain::face;
    Measure measure = Measure::number;
    std::string_view help;
    std::string_view missing{};                  ///< where there is none, in words: "on boundaries"
    std::vector<std::string_view> other_names{}; ///< synonyms
    bool is_signed = false;                      ///< the sign has a meaning
    bool compares = false;                       ///< it is from another surface
    std::vector<double> (*of)(const Quantity&, const Mesh& world, const FaceTree* other) = nullptr;
};

/// All of them, in the order of the help.
const std::vector<Quantity>& quantities();
[[nodiscard]] std::vector<std::string> quantity_names();
/// With what else people call them: for the nearest of a word.
[[nodiscard]] std::vector<std::string> quantity_words();
/// Null when there is none of that name.
[[nodiscard]] const Quantity* quantity_named(std::string_view name);
/// Also finds synonyms.
[[nodiscard]] const Quantity* quantity_called(std::string_view word);

/// "mm", "1/mm^2", "degrees"; "scene units" and the like where the unit is unknown, empty for pure numbers.
[[nodiscard]] std::string unit_of(const Quantity& quantity, Unit unit);

/// The numbers of the part's faces or vertices, in world space and scene units; not a number where there is
/// none. other: what quantities that compare are from, in world space; only these look at it. O(n log n); the
/// same for any number of threads.
[[nodiscard]] std::vector<double> values_of(const Quantity& quantity, const Part& part,
                                            const FaceTree* other = nullptr);

/// Makes an attribute of the values and replaces any attribute of that name; missing values become `none`, if
/// given.
void give_attribute(Part& part, const Quantity& quantity, std::vector<double> values,
                    std::optional<double> none = {});

} // namespace facetmill

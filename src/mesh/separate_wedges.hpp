#pragma once
// Separates wedges whose corners differ.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Splits wedges whose corners have different classes: appends copies with all attributes, in the order in
/// which corners need them. class_of_corner: [corners]. Returns the class of each wedge, `none` for wedges
/// without corners.
[[nodiscard]] std::vector<Index> separate_wedges(Mesh& mesh, const std::vector<Index>& class_of_corner);

} // namespace facetmill

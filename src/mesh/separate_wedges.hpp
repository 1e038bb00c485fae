#pragma once
// Wedges that come apart where their corners differ.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Gives corners of one wedge that are of different classes wedges of their own: copies with all attributes,
/// in the order in which corners need them, behind the others. class_of_corner: [corners]. Returns the class
/// of each wedge, `none` for those of no corner.
std::vector<Index> separate_wedges(Mesh& mesh, const std::vector<Index>& class_of_corner);

} // namespace facetmill

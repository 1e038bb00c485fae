#pragma once
// The face table of measure. Its columns are declared once, for the heading, the rows and the help.

#include "mesh/mesh.hpp"

#include <string>

namespace facetmill::measure_stage {

/// The heading: the names of the columns.
[[nodiscard]] std::string face_table_head();
/// One row per face of the part, whose mesh is in world space.
[[nodiscard]] std::string face_table_rows(const std::string& part, const Mesh& mesh);
/// The help text of the columns: "part (its name), face (its number, from 0), ...".
[[nodiscard]] std::string face_table_help();

} // namespace facetmill::measure_stage

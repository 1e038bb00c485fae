#pragma once
// The table of faces that measure writes: its columns are declared once, for the heading, the rows and the
// help.

#include "mesh/mesh.hpp"

#include <string>

namespace facetmill::measure_stage {

/// The heading: the names of the columns.
std::string face_table_head();
/// One row per face of the part, whose mesh is in world space.
std::string face_table_rows(const std::string& part, const Mesh& mesh);
/// "part (its name), face (its number, from 0), ...": the columns as the help tells them.
std::string face_table_help();

} // namespace facetmill::measure_stage

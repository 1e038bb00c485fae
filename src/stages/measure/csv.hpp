#pragma once
// The faces of a mesh as rows of a table.

#include "mesh/mesh.hpp"

#include <string>

namespace facetmill::report {

inline constexpr const char* face_rows_head = "part,face,corners,area,x,y,z,nx,ny,nz,off_plane\n";

/// One row per face: part, number, corners, area, centroid, unit normal, farthest corner from its plane.
std::string face_rows(const std::string& part, const Mesh& mesh);

} // namespace facetmill::report

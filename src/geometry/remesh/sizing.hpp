#pragma once
// Intended edge lengths.

#include "geometry/remesh/remesh.hpp"
#include "geometry/remesh/working_mesh.hpp"

namespace facetmill::remeshing {

/// [vertices of the laid-out mesh] the intended edge lengths: constant, or by curvature and graded.
[[nodiscard]] std::vector<double> intended_sizes(const WorkingMesh& mesh, const RemeshSettings& settings);

/// Lowers sizes until they grow by at most half of the distance along each edge.
void grade(const WorkingMesh& mesh, std::vector<double>& sizes);

/// The number of equilateral faces of these sizes on the surface.
[[nodiscard]] double expected_faces(const WorkingMesh& mesh, const std::vector<double>& sizes);

} // namespace facetmill::remeshing

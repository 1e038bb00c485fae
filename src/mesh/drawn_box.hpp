#pragma once
// The size of a mesh when drawn. Vertices that no face and no line uses do not count.

#include "mesh/mesh.hpp"

namespace facetmill {

/// True if faces or lines leave out a vertex. False for clouds of points, whose vertices are all drawn.
[[nodiscard]] bool has_unused_vertices(const Mesh& mesh);

/// The box around the vertices of faces and lines, after a transform; around all vertices of a cloud.
[[nodiscard]] Box drawn_box(const Mesh& mesh, const Transform& t = {});

} // namespace facetmill

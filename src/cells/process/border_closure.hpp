#pragma once
// Closes a part of a mesh by faces that represent the rest of the mesh.

#include "mesh/mesh.hpp"

namespace facetmill::cells {

/// Triangles between points (numbered from the mesh's vertex count) and vertices of the mesh.
struct Collar {
    std::vector<Vec3> points;
    std::vector<Index> corners;
};

/// Makes the collar of a part. Requires that the rest is a closed manifold surface, except where it meets
/// the part. The collar meets the part in the same way. Each vertex has the same number of face fans, and
/// faces are connected if the rest's edges connect them. A part with its collar is therefore closed,
/// manifold or an open sheet exactly as in the whole. The collar's points are arbitrary: no point coincides
/// with a vertex, and no face is degenerate (except by chance). part: [faces] nonzero for faces of the part;
/// the mesh also has all other faces with a vertex of these. sheet: [faces] for the others, the number of
/// their component over edges of the rest. If the rest does not meet the part, the collar is a separate
/// tetrahedron.
[[nodiscard]] Collar border_closure_of(const Mesh& mesh, const std::vector<std::uint8_t>& part,
                                       const std::vector<std::uint32_t>& sheet);

} // namespace facetmill::cells

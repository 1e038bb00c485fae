#pragma once
// A part of a mesh closed by faces that stand for the rest of it.

#include "mesh/mesh.hpp"

namespace facetmill::cells {

/// Faces of points (from the mesh's vertex count on) and vertices of the mesh, three corners each.
struct Collar {
    std::vector<Vec3> points;
    std::vector<Index> corners;
};

/// The rest is a surface that is closed and manifold, but where it meets the part. The collar meets the part
/// the same way: around each vertex as many faces hang together, and hang together what does over the edges
/// of the rest. So what is closed, manifold, or an open sheet in the whole is in the part with its collar.
/// Its points are nowhere in particular: none is where a vertex is, and no face of it has no area (but for
/// chance).
///
/// part: [faces] not 0 for those of the part; the mesh also has all other faces that have a vertex of theirs.
/// sheet: [faces] for the others, the number of what they hang together with over edges of the rest. Where
/// nothing meets the part, the collar is a tetrahedron that stands apart.
Collar border_closure_of(const Mesh& mesh, const std::vector<std::uint8_t>& part,
                         const std::vector<std::uint32_t>& sheet);

} // namespace facetmill::cells

#pragma once
// The surface of a mesh or a part, without what stands on it.

#include "mesh/placement.hpp"

namespace facetmill {

/// The positions and faces alone, with the mesh's own numbers of vertices, wedges, corners and faces:
/// attributes and primitives are left behind. O(n).
inline Mesh bare(const Mesh& mesh) {
    Mesh out;
    out.positions = mesh.positions;
    out.wedge_vertex = mesh.wedge_vertex;
    out.corners = mesh.corners;
    out.face_offsets = mesh.face_offsets;
    return out;
}

/// The bare mesh of a part as it stands in the world; the faces of a mirrored part are turned round, so that
/// they keep their front. O(n).
inline Mesh in_world(const Part& part) {
    Mesh out = bare(part.mesh);
    apply(out, effective(part));
    return out;
}

} // namespace facetmill

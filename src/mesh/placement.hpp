#pragma once
// Where a part stands, and its bare surface there.

#include "mesh/scene.hpp"

namespace facetmill {

/// The place in the world of a point of the part.
inline Vec3 in_world(const Part& part, const Vec3& p) { return part.transform.point(p); }

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
    apply(out, part.transform);
    return out;
}

} // namespace facetmill

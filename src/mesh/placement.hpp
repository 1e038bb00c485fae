#pragma once
// Converts a part's points and bare surface to world space.

#include "mesh/scene.hpp"

namespace facetmill {

/// The world position of a point of the part.
[[nodiscard]] inline Vec3 in_world(const Part& part, const Vec3& p) { return part.transform.point(p); }

/// Only the positions and faces, with the same numbers of vertices, wedges, corners and faces; without
/// attributes and primitives. O(n).
[[nodiscard]] inline Mesh bare(const Mesh& mesh) {
    Mesh out;
    out.positions = mesh.positions;
    out.wedge_vertex = mesh.wedge_vertex;
    out.corners = mesh.corners;
    out.face_offsets = mesh.face_offsets;
    return out;
}

/// The bare mesh of a part in world space; the faces of a mirrored part are reversed, so that they keep
/// their front. O(n).
[[nodiscard]] inline Mesh in_world(const Part& part) {
    Mesh out = bare(part.mesh);
    apply(out, part.transform);
    return out;
}

} // namespace facetmill

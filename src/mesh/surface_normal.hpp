#pragma once
// The area vector of a face in the world, and how much two of them bend.

#include "mesh/area_vector.hpp"

namespace facetmill {

/// In world space (of a mirroring transform, it looks the other way).
inline Vec3 area_vector(const Mesh& mesh, Index f, const Transform& to_world) {
    const Vec3& first = mesh.point(mesh.face_begin(f));
    return area_vector_at(mesh, f, [&](Index c) { return to_world.vector(mesh.point(c) - first); });
}

/// Whether the angle between normals of that dot product is more than the one of that cosine. What is more by
/// rounding alone (1e-12 of the cosine) is not: a right angle does not bend by more than 90 degrees.
inline bool bends_more(double dot_product, double cosine) { return dot_product < cosine - 1e-12; }

} // namespace facetmill

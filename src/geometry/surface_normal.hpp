#pragma once
// The area vector of a face, and how much two of them bend.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Twice the area of face f along its normal (Newell's sum, taken from the first corner), its corners being
/// where place(corner) says.
template <class Place>
Vec3 area_vector_at(const Mesh& mesh, Index f, Place&& place) {
    Vec3 sum;
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    const Vec3 first = place(begin);
    for (Index c = begin + 1; c + 1 < end; ++c) sum += cross(place(c) - first, place(c + 1) - first);
    return sum;
}

inline Vec3 area_vector(const Mesh& mesh, Index f) {
    return area_vector_at(mesh, f, [&](Index c) { return mesh.point(c); });
}

/// In world space (of a mirroring transform, it looks the other way).
inline Vec3 area_vector(const Mesh& mesh, Index f, const Transform& to_world) {
    const Vec3& first = mesh.point(mesh.face_begin(f));
    return area_vector_at(mesh, f, [&](Index c) { return to_world.vector(mesh.point(c) - first); });
}

/// Whether the angle between normals of that dot product is more than the one of that cosine. What is more by
/// rounding alone (1e-12 of the cosine) is not: a right angle does not bend by more than 90 degrees.
inline bool bends_more(double dot_product, double cosine) { return dot_product < cosine - 1e-12; }

} // namespace facetmill

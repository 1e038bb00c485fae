#pragma once
// The area vector of a face.

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

} // namespace facetmill

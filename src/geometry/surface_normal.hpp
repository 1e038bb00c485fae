#pragma once
// The area vector of a face.

#include "mesh/mesh.hpp"

namespace facetmill {

/// Twice the area of face f along its normal (Newell's sum, taken from the first corner).
inline Vec3 area_vector(const Mesh& mesh, Index f) {
    Vec3 sum;
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    for (Index c = begin + 1; c + 1 < end; ++c)
        sum += cross(mesh.point(c) - mesh.point(begin), mesh.point(c + 1) - mesh.point(begin));
    return sum;
}

} // namespace facetmill

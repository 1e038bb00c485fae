#pragma once
// On which side of each component of a surface its inside is.

#include "mesh/topology.hpp"

namespace facetmill {

/// Six times the signed volume of each component, seen from its first corner in order to lose no digits far
/// from the origin; negative where the faces look inwards. Exact but for rounding where a component is
/// closed; of an open one it depends on that corner. place(corner) is where a corner is.
template <class Place>
std::vector<double> six_volumes(const Mesh& mesh, const Components& components, Place&& place) {
    std::vector<double> volumes(components.count, 0);
    std::vector<Index> first(components.count, none);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index component = components.of_face[f], begin = mesh.face_begin(f);
        if (mesh.face_size(f) < 3) continue;
        if (first[component] == none) first[component] = begin;
        const Vec3 o = place(first[component]), a = place(begin) - o;
        for (Index c = begin + 1; c + 1 < mesh.face_end(f); ++c)
            volumes[component] += dot(a, cross(place(c) - o, place(c + 1) - o));
    }
    return volumes;
}

inline std::vector<double> six_volumes(const Mesh& mesh, const Components& components) {
    return six_volumes(mesh, components, [&](Index c) { return mesh.point(c); });
}

} // namespace facetmill

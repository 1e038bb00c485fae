#pragma once
// Signed volumes of the components of a surface, which show where the inside is.

#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

/// Six times the signed volume of each component, relative to its first corner to keep precision far from
/// the origin; negative if the faces face inwards. Exact up to rounding for a closed component; for an open
/// component it depends on that corner. place(corner) returns the position of a corner.
template <class Place>
[[nodiscard]] std::vector<double> six_volumes(const Mesh& mesh, const Components& components, Place&& place) {
    std::vector<double> volumes(components.count, 0);
    std::vector<Index> first(components.count, none);
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) >= 3 && first[components.of_face[f]] == none)
            first[components.of_face[f]] = mesh.face_begin(f);
    const auto of_triangle = [&](Index component, Index a, Index b, Index c) {
        const Vec3 o = place(first[component]);
        return dot(place(a) - o, cross(place(b) - o, place(c) - o));
    };
    if (mesh.all_triangles()) { // all threads compute the terms; they are added in order, as below
        std::vector<double> of_face(mesh.face_count());
        parallel_for(of_face.size(), [&](std::size_t f) {
            const auto c = static_cast<Index>(3 * f);
            of_face[f] = of_triangle(components.of_face[f], c, c + 1, c + 2);
        });
        for (std::size_t f = 0; f < of_face.size(); ++f) volumes[components.of_face[f]] += of_face[f];
        return volumes;
    }
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f) + 1; c + 1 < mesh.face_end(f); ++c)
            volumes[components.of_face[f]] +=
                of_triangle(components.of_face[f], mesh.face_begin(f), c, c + 1);
    return volumes;
}

[[nodiscard]] inline std::vector<double> six_volumes(const Mesh& mesh, const Components& components) {
    return six_volumes(mesh, components, [&](Index c) { return mesh.point(c); });
}

} // namespace facetmill

// Distances through the air around a solid, and sizes of its components.
#include "geometry/inspect/measures.hpp"
#include "mesh/placement.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill::inspect_room {

namespace {

/// The bare mesh with its inside and outside exchanged: its walls are gaps.
Mesh inside_out(const Mesh& mesh) {
    Mesh turned = bare(mesh);
    parallel_for(turned.face_count(), [&](std::size_t f) {
        const auto face = static_cast<Index>(f);
        std::reverse(turned.corners.begin() + turned.face_begin(face),
                     turned.corners.begin() + turned.face_end(face));
    });
    return turned;
}

} // namespace

std::vector<double> gaps(const Mesh& mesh) { return wall_thicknesses(inside_out(mesh)); }

std::optional<double> smallest_gap(const Measured& mesh) {
    const Mesh turned = inside_out(mesh.world);
    return thinnest_wall({turned, turned, mesh.properties, mesh.settings});
}

std::vector<double> details(const Mesh& mesh) {
    std::vector<double> all = wall_thicknesses(mesh);
    const std::vector<double> of_air = gaps(mesh);
    for (std::size_t f = 0; f < all.size(); ++f) all[f] = std::min(all[f], of_air[f]);
    return all;
}

std::optional<double> smallest_detail(const Measured& mesh) {
    const std::optional<double> wall = thinnest_wall(mesh), gap = smallest_gap(mesh);
    return wall && gap ? std::min(*wall, *gap) : wall ? wall : gap;
}

std::vector<double> component_sizes(const Mesh& mesh) {
    const Components components = face_components(mesh);
    std::vector<Box> boxes(components.count);
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            boxes[components.of_face[f]].add(mesh.point(c));
    std::vector<double> sizes(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f) sizes[f] = boxes[components.of_face[f]].diagonal();
    return sizes;
}

} // namespace facetmill::inspect_room

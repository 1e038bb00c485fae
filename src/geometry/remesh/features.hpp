#pragma once
// Makes the working mesh, and finds the edges and vertices that remeshing must keep.

#include "geometry/remesh/working_mesh.hpp"

namespace facetmill::remeshing {

/// The working mesh of a triangle mesh. Faces with a repeated corner are left out, but keep their number in
/// `regions_of_faces`. sizes and hints stay empty.
struct LaidOut {
    WorkingMesh mesh;
    std::vector<Index> regions_of_faces; ///< [faces of the input] regions
    std::size_t locked_edges = 0, dropped_faces = 0;
};
/// Connected sharp edges with a total length below least_line are noise, not features.
[[nodiscard]] LaidOut lay_out(const Mesh& mesh, double feature_angle, double least_line);

} // namespace facetmill::remeshing

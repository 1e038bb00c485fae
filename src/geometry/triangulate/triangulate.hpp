#pragma once
// Faces of any kind into triangles, and the census of what kinds of face a mesh has.

#include "geometry/polygon/polygon.hpp"
#include "mesh/scene.hpp"

#include <array>

namespace facetmill {

/// The note's types of polygon over a mesh's faces, each seen along the coordinate axis nearest to its
/// normal.
struct FaceKinds {
    std::array<std::size_t, polygon::kinds> of_kind{}; ///< by polygon::Kind
    std::size_t non_planar = 0;                        ///< farther from their plane than the tolerance
    double deviation = 0;                              ///< the largest polygon::plane_deviation, mesh units
    Index worst = none;                                ///< the first face that far from its plane

    std::size_t count(polygon::Kind kind) const { return of_kind[static_cast<std::size_t>(kind)]; }
};

/// Counts the faces by kind. A face is not planar when a corner is farther from its plane than planar times
/// the face's perimeter; the default is what float32 coordinates can tell. Parallel.
FaceKinds face_kinds(const Mesh& mesh, double planar = 1e-6);
/// Over all parts as they stand in the world; worst is none.
FaceKinds face_kinds(const Scene& scene, double planar = 1e-6);

struct TriangulateResult {
    Mesh mesh;
    AttributeChanges changes;
    FaceKinds kinds;      ///< of the faces that came in
    std::size_t cut = 0;  ///< faces that became several
    std::size_t fans = 0; ///< among them, self-intersecting or without area: cut as fans
};

/// Cuts every face of four corners or more into its corners less two triangles, without new points, so that
/// closed stays closed and neighbours still match. Vertices, wedges and their attributes are kept, face
/// attributes copied.
/// - Quads that are convex: along the shorter diagonal (ties: the one at the first corner).
/// - Convex, concave, and complex faces (holes joined by coincident edges): constrained Delaunay of the
/// corners seen along
///   the coordinate axis nearest to the area vector, which is the projection for faces that are not planar
///   too. Corners at the same place keep their own wedges.
/// - Self-intersecting faces: by windings. A fan from the first corner; its triangles may lie over each other
/// or face
///   backwards, and add up at every point to how often the face winds around it. Faces without area: the same
///   fan.
TriangulateResult triangulate(const Mesh& mesh);

} // namespace facetmill

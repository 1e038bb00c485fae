#pragma once
// Triangulates faces of any kind, and counts the kinds of face of a mesh.

#include "geometry/polygon/polygon.hpp"
#include "mesh/mesh.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <span>

namespace facetmill {

/// The types of polygon of P. Bourke, "Polygon types" (1993), over a mesh's faces, each seen along the
/// coordinate axis nearest to its normal.
struct FaceKinds {
    std::array<std::size_t, polygon::kinds> of_kind{}; ///< by polygon::Kind
    std::size_t non_planar = 0;                        ///< farther from their plane than the tolerance
    double deviation = 0;                              ///< the largest polygon::plane_deviation, mesh units
    Index worst = none;                                ///< the first face that far from its plane

    std::size_t count(polygon::Kind kind) const { return of_kind[static_cast<std::size_t>(kind)]; }
};

/// Puts the corners of face f into `corners`.
void face_corners(const Mesh& mesh, Index f, std::vector<Vec3>& corners);

/// The kind of polygon of these corners.
[[nodiscard]] polygon::Kind face_kind(std::span<const Vec3> corners);
/// Whether corners with this deviation from their plane (polygon::plane_deviation) count as planar: at most
/// planar times the perimeter.
bool is_planar(std::span<const Vec3> corners, double deviation, double planar = 1e-6);

/// Counts the faces by kind. A face is not planar if a corner is farther from its plane than planar times
/// the face's perimeter. The default is the resolution of float32 coordinates. Parallel.
[[nodiscard]] FaceKinds face_kinds(const Mesh& mesh, double planar = 1e-6);
/// Counts over all parts in world space; worst is none.
[[nodiscard]] FaceKinds face_kinds(const Scene& scene, double planar = 1e-6);

struct TriangulateResult {
    Mesh mesh;
    AttributeChanges changes;
    FaceKinds kinds;      ///< of the faces that came in
    std::size_t cut = 0;  ///< faces that became several triangles
    std::size_t fans = 0; ///< among them, self-intersecting or without area: cut as fans
};

/// Cuts every face of four corners or more into its corners less two triangles, without new points, so that
/// closed stays closed and neighbours still match. Vertices, wedges and their attributes are kept, face
/// attributes copied.
/// - Quads that are convex: along the shorter diagonal (ties: the diagonal at the first corner).
/// - Convex, concave, and complex faces (holes joined by coincident edges): constrained Delaunay of the
/// corners, projected along the coordinate axis nearest to the area vector, even for faces that are not
/// planar. Coincident corners keep their own wedges.
/// - Self-intersecting faces: by windings. A fan from the first corner; its triangles may overlap each other
/// or face backwards, and add up at every point to the winding number of the face. Faces without area: the
/// same fan.
[[nodiscard]] TriangulateResult triangulate(const Mesh& mesh);

struct PairSettings {
    double min_cosine =
        0.984807753012208; ///< of the largest angle between the two halves' normals (10 degrees)
    double cos_corner =
        0.866025403784439; ///< of the smallest corner a quad may have, and its largest's supplement (30)
};

struct PairResult {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t quads = 0;     ///< made
    std::size_t triangles = 0; ///< left
};

/// Merges pairs of triangles across an edge of exactly two faces, if they run along it opposite ways with
/// the same wedges and have the same primitive. The edge whose quad has corners nearest to right angles goes
/// first (ties: the lower edge); each triangle is used once. Vertices and wedges are kept. A quad replaces
/// its first triangle and has its face attributes. Other faces stay unchanged.
[[nodiscard]] PairResult pair_triangles(const Mesh& mesh, const PairSettings& settings = {});

} // namespace facetmill

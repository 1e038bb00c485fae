#pragma once
// Triangulates faces of any kind, and counts the kinds of faces.

#include "geometry/polygon/polygon.hpp"
#include "mesh/mesh.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <span>

namespace facetmill {

/// The types of polygon of P. Bourke, "Polygon types" (1993), for a mesh's faces, each projected along the
/// coordinate axis nearest to its normal.
struct FaceKinds {
    std::array<std::size_t, polygon::kinds> of_kind{}; ///< counts by polygon::Kind
    std::size_t non_planar = 0;                        ///< farther from their plane than the tolerance
    double deviation = 0;                              ///< the largest polygon::plane_deviation, mesh units
    Index worst = none;                                ///< the first face with this deviation

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
/// Counts over all parts in world space; `worst` stays none.
[[nodiscard]] FaceKinds face_kinds(const Scene& scene, double planar = 1e-6);

struct TriangulateResult {
    Mesh mesh;
    AttributeChanges changes;
    FaceKinds kinds;     ///< kinds of the input faces
    std::size_t cut = 0; ///< faces that became several triangles
    std::size_t fans =
        0; ///< the part of these that was cut as fans, because they intersect themselves or have no area
};

/// Cuts every face with n >= 4 corners into n - 2 triangles, without new points. So closed meshes stay
/// closed, and neighbours still match. Keeps vertices, wedges and their attributes, and copies face
/// attributes.
/// - Convex quads: cut along the shorter diagonal (ties: the diagonal at the first corner).
/// - Convex, concave, and complex faces (holes joined by coincident edges): constrained Delaunay of the
///   corners, projected along the coordinate axis nearest to the area vector, even for faces that are not
///   planar. Coincident corners keep their own wedges.
/// - Self-intersecting faces, and faces without area: a fan from the first corner. Its triangles may overlap
///   or face backwards; at every point they add up to the winding number of the face.
[[nodiscard]] TriangulateResult triangulate(const Mesh& mesh);

struct PairSettings {
    double min_cosine =
        0.984807753012208; ///< cosine of the largest angle between the normals of both halves (10 degrees)
    double cos_corner = 0.866025403784439; ///< cosine of the smallest angle of a quad, and of the supplement
                                           ///< of its largest (30 degrees)
};

struct PairResult {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t quads = 0;     ///< quads made
    std::size_t triangles = 0; ///< triangles left
};

/// Merges pairs of triangles across an edge of exactly two faces. They must run along the edge in opposite
/// directions, with the same wedges and the same primitive. Edges whose quads have corners nearest to right
/// angles are merged first (ties: the lower edge). Each triangle is used once. Vertices and wedges stay. A
/// quad replaces its first triangle and gets its face attributes. Other faces stay unchanged.
[[nodiscard]] PairResult pair_triangles(const Mesh& mesh, const PairSettings& settings = {});

} // namespace facetmill

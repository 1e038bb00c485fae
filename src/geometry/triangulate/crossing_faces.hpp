#pragma once
// Triangulates self-crossing faces so that the triangles cover the inside.

#include "mesh/surface.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace facetmill {

/// For a planar polygon whose outline crosses itself: triangles over the region that the outline winds
/// around, each point once (nonzero rule), all oriented by the polygon's normal. Empty for any other
/// polygon, at little more than the cost of a convexity test.
[[nodiscard]] std::vector<std::array<Vec3, 3>> covering_triangles(std::span<const Vec3> corners);

/// The area of a polygon: the region that it winds around if it crosses itself in its plane
/// (covering_triangles), otherwise the length of its area vector. O(n) for convex and small polygons,
/// otherwise O(n log n).
[[nodiscard]] double covered_area(std::span<const Vec3> corners);

struct CrossingFaces {
    std::optional<Mesh> mesh;    ///< empty if no face needed filling
    AttributeChanges changes;    ///< attribute changes of the mesh
    std::size_t filled = 0;      ///< faces that became triangles
    std::size_t overlapping = 0; ///< among them, faces whose triangles overlap each other
    /// Faces whose triangles may overlap: nonplanar faces of five or more corners that cross themselves
    /// (projected along the axis nearest to their normal), and faces that could not be filled.
    std::size_t fans = 0;
};

/// Faces whose outline crosses or touches itself in its plane become triangles that cover the region it winds
/// around (nonzero rule). The triangles are reversed where it winds clockwise. The even-odd rule would leave
/// a hole where a face overlaps itself, unlike drawings and the union of solids. Each crossing gets a new
/// vertex, interpolated along the edges, in all faces along these edges. So closed meshes stay closed, and
/// other faces may gain corners. If the outline winds around a region several times, the region is covered
/// once if the face has no neighbours. With neighbours, it is covered as often as the outline winds around it
/// (the triangles overlap), because otherwise the surface would be open. Constrained Delaunay, exact. Only
/// planar faces are filled (within a millionth of their perimeter, as in face_kinds). Faces whose crossings
/// round to other crossings stay unchanged. Triangles are skipped.
[[nodiscard]] CrossingFaces fill_crossing_faces(const Mesh& mesh);

/// The value of CrossingFaces::fans, without making the mesh.
[[nodiscard]] std::size_t count_fans(const Mesh& mesh);

/// triangulated() after fill_crossing_faces: the triangles for files and pictures.
[[nodiscard]] Mesh triangles_of(const Mesh& mesh);

/// surface_of() after fill_crossing_faces: the covered surface for distances, rays and samples. New vertices
/// follow the mesh's vertices.
[[nodiscard]] Surface filled_surface(const Mesh& mesh);

} // namespace facetmill

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
/// (covering_triangles), else the length of its area vector. O(n) for convex and small polygons, else O(n
/// log n).
[[nodiscard]] double covered_area(std::span<const Vec3> corners);

struct CrossingFaces {
    std::optional<Mesh> mesh;    ///< none: no face was to be filled
    AttributeChanges changes;    ///< of mesh
    std::size_t filled = 0;      ///< faces that became triangles
    std::size_t overlapping = 0; ///< among them, faces whose triangles overlap each other
    /// Faces of five or more corners that cross themselves in no plane (seen along the axis nearest to their
    /// normal), and those that could not be filled: their triangles may overlap.
    std::size_t fans = 0;
};

/// Faces whose outline crosses or touches itself in its plane become triangles that cover the region it
/// winds around (nonzero rule). They face the other way where it winds clockwise. The even-odd rule would
/// leave a hole where a face overlaps itself, unlike drawings and the union of solids. Each crossing gets a
/// new vertex, interpolated along the edges, on all faces along them. So closed meshes stay closed, and
/// other faces may gain corners. A region wound around several times is covered once if the face has no
/// neighbours. Else it is covered as many times, because the surface would be open otherwise (overlapping).
/// Constrained Delaunay, exact. Only planar faces are filled (within a millionth of their perimeter, as in
/// face_kinds). Faces whose crossings round to other crossings stay unchanged. If no face is filled, each
/// face is visited once; triangles never are.
[[nodiscard]] CrossingFaces fill_crossing_faces(const Mesh& mesh);

/// CrossingFaces::fans, without the mesh.
[[nodiscard]] std::size_t count_fans(const Mesh& mesh);

/// triangulated, after fill_crossing_faces: the triangles of a file or a picture.
[[nodiscard]] Mesh triangles_of(const Mesh& mesh);

/// surface_of, after fill_crossing_faces: the covered surface for distances, rays and samples. New vertices
/// follow the mesh's vertices.
[[nodiscard]] Surface filled_surface(const Mesh& mesh);

} // namespace facetmill

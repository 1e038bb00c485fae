#pragma once
// A surface as bare triangles in one space, for distances, rays and samples. On request, point clouds and
// unused vertices count as triangles of a single point.

#include "mesh/scene.hpp"

#include <array>
#include <span>
#include <vector>

namespace facetmill {

/// Triangles by index. Faces of several parts are numbered consecutively, in the order of the parts.
struct Surface {
    std::vector<Vec3> positions;
    std::vector<Index> corners; ///< three per triangle, indices of positions
    std::vector<Index> faces;   ///< the face of each triangle; empty: triangle t is face t

    std::size_t size() const { return corners.size() / 3; }
    Index face(std::size_t triangle) const {
        return faces.empty() ? static_cast<Index>(triangle) : faces[triangle];
    }
    const Vec3& point(std::size_t triangle, std::size_t corner) const {
        return positions[corners[3 * triangle + corner]];
    }
    /// The box of the finite vertices of triangles.
    Box bounds() const;
};

/// The surface of a mesh in its own space, with its own vertices. Polygons are cut as `triangulated` does,
/// so self-crossing polygons become overlapping fans (geometry/triangulate/crossing_faces.hpp has
/// filled_surface).
[[nodiscard]] Surface surface_of(const Mesh& mesh);

using SurfaceOfMesh = Surface (*)(const Mesh&);
/// The surface of a part in world space.
[[nodiscard]] Surface surface_of(const Part& part, SurfaceOfMesh of_mesh = surface_of);
/// The surface of these parts, or of a scene, in world space. Throws a limit error (E-LIMIT) if the vertices
/// cannot be numbered.
[[nodiscard]] Surface surface_of(std::span<const Part* const> parts, SurfaceOfMesh of_mesh = surface_of);
[[nodiscard]] Surface surface_of(const Scene& scene, SurfaceOfMesh of_mesh = surface_of);

/// The vertices of all parts that no face uses, in world space. Each is a triangle of a single point without
/// a face, so that distances work like for a surface. They follow the order of parts and vertices. Throws a
/// limit error (E-LIMIT) if they cannot be numbered.
[[nodiscard]] Surface isolated_vertices_of(const Scene& scene);

/// The basis of distances of a scene: its surface or, without faces, its points. Throws the same error.
[[nodiscard]] Surface surface_or_points_of(const Scene& scene, SurfaceOfMesh of_mesh = surface_of);

/// Both surfaces merged. Throws the same error.
[[nodiscard]] Surface joined(Surface a, const Surface& b);

} // namespace facetmill

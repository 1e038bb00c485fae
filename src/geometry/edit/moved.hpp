#pragma once
// Updates attributes after a stage moves vertices without changing the connectivity, and measures the change
// of size.

#include "mesh/mesh.hpp"

#include <optional>

namespace facetmill {

/// Call it after positions changed. Recomputes the wedge attribute NORMAL and makes TANGENT (float32 or
/// float64) perpendicular to it again; other attributes stay. Returns the change of every attribute, in the
/// mesh's order.
[[nodiscard]] AttributeChanges settle_moved(Mesh& mesh);

/// Removes the component along NORMAL from the wedge attribute TANGENT (float32 or float64). Returns whether
/// the mesh has one.
bool straighten_tangents(Mesh& mesh);

/// How far vertices moved, in world units.
struct MoveSize {
    double largest = 0, root_mean_square = 0; ///< over all vertices; 0 without any
    std::size_t count = 0;                    ///< moved vertices
};
[[nodiscard]] MoveSize move_size(const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                                 const Transform& to_world = {});

/// The area (by covered_area of each face) and, if the surface is closed, the signed volume, in world space.
/// Unless known, closedness is decided by a 64-bit sum of hashed directed edges, which is zero if they
/// cancel. O(corners), parallel.
struct SurfaceSize {
    double area = 0;
    std::optional<double> volume;
};
[[nodiscard]] SurfaceSize surface_size(const Mesh& mesh, const Transform& to_world = {},
                                       std::optional<bool> closed = std::nullopt);

} // namespace facetmill

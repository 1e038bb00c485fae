#pragma once
// Updates attributes after a stage moves vertices without changing the connectivity, and measures the change
// of size.

#include "mesh/mesh.hpp"

#include <optional>

namespace facetmill {

/// Call it after positions changed. Recomputes wedge attribute NORMAL and makes TANGENT (float32 or float64)
/// perpendicular to it again; other attributes stay. Returns the change of every attribute, in the mesh's
/// order.
[[nodiscard]] AttributeChanges settle_moved(Mesh& mesh);

/// Removes the component along NORMAL from the wedge attribute TANGENT (float32 or float64). Returns whether
/// the mesh has one.
bool straighten_tangents(Mesh& mesh);

/// How far vertices came from where they were, in world units.
struct MoveSize {
    double largest = 0, root_mean_square = 0; ///< over all vertices; 0 without any
    std::size_t count = 0;                    ///< vertices that are elsewhere
};
[[nodiscard]] MoveSize move_size(const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                                 const Transform& to_world = {});

/// Area (of a face, its covered_area) and, when closed, signed volume, in world space. Closed is
/// decided by a 64-bit sum of hashed directed edges, which is zero when they cancel, unless it is known.
/// O(corners), parallel.
struct SurfaceSize {
    double area = 0;
    std::optional<double> volume;
};
[[nodiscard]] SurfaceSize surface_size(const Mesh& mesh, const Transform& to_world = {},
                                       std::optional<bool> closed = std::nullopt);

} // namespace facetmill

#pragma once
// What becomes of the attributes when a stage moves vertices and leaves the connectivity alone, and of the
// size of what they enclose.

#include "mesh/mesh.hpp"

#include <optional>

namespace facetmill {

/// Call it after positions changed: wedge attribute NORMAL is recomputed, TANGENT (float32 or float64) is
/// made perpendicular to it again, the others are as they were. Returns what became of every attribute, in
/// the mesh's order.
AttributeChanges settle_moved(Mesh& mesh);

/// Takes the part along NORMAL out of the wedge attribute TANGENT (float32 or float64); whether there was
/// one.
bool straighten_tangents(Mesh& mesh);

/// How far vertices came from where they were, in world units.
struct MoveSize {
    double largest = 0, root_mean_square = 0; ///< over all vertices; 0 without any
    std::size_t count = 0;                    ///< vertices that are elsewhere
};
MoveSize move_size(const std::vector<Vec3>& before, const std::vector<Vec3>& after,
                   const Transform& to_world = {});

/// Area (of a face, its covered_area) and, when closed, signed volume, in world space. Closed is
/// decided by a 64-bit sum of hashed directed edges, which is zero when they cancel, unless it is known.
/// O(corners), parallel.
struct SurfaceSize {
    double area = 0;
    std::optional<double> volume;
};
SurfaceSize surface_size(const Mesh& mesh, const Transform& to_world = {},
                         std::optional<bool> closed = std::nullopt);

} // namespace facetmill

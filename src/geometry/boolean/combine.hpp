#pragma once
// Boolean operations on solids, with the same algorithm as clean's union of solids.

#include "mesh/mesh.hpp"

#include <optional>
#include <string>
#include <vector>

namespace facetmill {

enum class CombineOperation {
    unite,     ///< points in at least one of the solids
    subtract,  ///< points in a solid of the first operand and in none of the second
    intersect, ///< points in a solid of the first operand and in one of the second
};

struct CombineSettings {
    CombineOperation operation = CombineOperation::unite;
    Index second = none; ///< the second operand starts at this mesh
};

/// Why the operation failed.
struct CombineFailure {
    std::string why;
    Index mesh = none; ///< the unsuitable mesh; none if the result is unsuitable
    Vec3 at;
};

struct CombineResult {
    Mesh mesh;
    std::vector<Index> mesh_of_face; ///< [faces] source meshes
    AttributeChanges changes;
    std::size_t cut_faces = 0;     ///< faces that intersect others outside of buried regions
    std::size_t covered_faces = 0; ///< uncut faces that were removed
    std::optional<CombineFailure> failure;
    bool short_of_memory = false; ///< memory was short; with more memory, the operation may succeed
};

/// Combines closed, consistently oriented meshes. The solid of a mesh is the set of points with a winding
/// number of at least 1. So meshes may intersect themselves and contain cavities. Faces without area are
/// removed first.
///
/// Intersecting faces are cut along each other, exactly (Q. Zhou et al., "Mesh arrangements for solid
/// geometry", 2016), except deep inside solids (geometry/boolean/buried.hpp). A piece or uncut face stays if
/// the solid is on exactly one of its sides. Then coordinates are rounded, and intersections caused by
/// rounding are united again, up to eight times. On success the result is closed and edge-manifold: solids
/// that touch at an edge or vertex are separated there. It does not intersect itself, except that faces may
/// touch at equal positions. It is empty if no point satisfies the operation.
///
/// Uncut faces stay polygons, in order of the meshes; pieces are triangles and come last. Cut faces keep only
/// vertices that they had or that other faces need (geometry/boolean/redrawn.hpp). If faces of several meshes
/// coincide, the face of the first mesh stays. When the second operand is subtracted, its faces are reversed
/// with their normals. Attributes that only some meshes have are added to the others, as in `append`. New
/// corners interpolate within the face that they are cut from.
///
/// Never throws for valid meshes. The result does not depend on the number of threads.
[[nodiscard]] CombineResult combine(std::vector<Mesh> meshes, const CombineSettings& settings);

} // namespace facetmill

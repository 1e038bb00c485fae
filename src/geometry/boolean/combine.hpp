#pragma once
// Boolean operations on solids, by the machinery that clean unites solids with.

#include "mesh/mesh.hpp"

#include <optional>
#include <string>
#include <vector>

namespace facetmill {

enum class CombineOperation {
    unite,     ///< what is in any of them
    subtract,  ///< what is in one of the first, and in none of the second
    intersect, ///< what is in one of the first and in one of the second
};

struct CombineSettings {
    CombineOperation operation = CombineOperation::unite;
    Index second = none; ///< the meshes from this one on are the second operand
};

/// Why nothing was done.
struct CombineFailure {
    std::string why;
    Index mesh = none; ///< that does not fit; none: what they came to
    Vec3 at;
};

struct CombineResult {
    Mesh mesh;
    std::vector<Index> mesh_of_face; ///< [faces] which of the meshes each is part of
    AttributeChanges changes;
    std::size_t cut_faces = 0;     ///< that met others, elsewhere than deep in a third solid
    std::size_t covered_faces = 0; ///< that were not cut and went
    std::optional<CombineFailure> failure;
    bool short_of_memory = false; ///< the reason for the failure: with more, the result would be another
};

/// Combines closed, consistently oriented meshes, whose solid is what they wind around at least once: they
/// may pass through themselves, and hold cavities. Faces without area are taken out first. All faces that
/// meet are cut along each other, exactly (Q. Zhou et al., "Mesh arrangements for solid geometry", 2016), but
/// for what lies deep in a union or in what is taken away (geometry/boolean/buried.hpp), and each piece, or
/// face that was not cut, stays where it has the solid on one side only. Coordinates are rounded then, and
/// what intersects by that is united again, up to eight times. So the result is closed and edge-manifold
/// (what touches at an edge or a vertex comes apart there), and intersects nowhere but where faces touch at
/// equal positions; or there is a failure. It is empty where the solids have nothing in common.
///
/// Faces that are not cut stay polygons; first those of the first mesh, in order; pieces are triangles and
/// come last. Of cut faces only those vertices stay that they had or that others need
/// (geometry/boolean/redrawn.hpp). Where faces of several meshes coincide, the first mesh's stays. Faces of
/// the second operand that bound what is taken away are turned round, with their normals. Attributes that
/// only some meshes have are added to the others as `append` does; new corners get theirs by interpolation
/// within the face that they are cut from. Throws never for valid meshes. The same for any number of threads.
CombineResult combine(std::vector<Mesh> meshes, const CombineSettings& settings);

} // namespace facetmill

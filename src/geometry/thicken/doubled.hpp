#pragma once
// A surface and its reversed copy, with walls between them; for thicken, extrude and two-sided.

#include "mesh/mesh.hpp"
#include "mesh/provenance.hpp"

#include <utility>
#include <vector>

namespace facetmill {

/// The surface and its back. The back of face f is face f + face_count, and the back of wedge w is w +
/// wedge_count.
struct Doubled {
    Mesh mesh;                 ///< has an explicit wedge_vertex, and no attributes
    MeshProvenance provenance; ///< complete for these faces; callers extend it
};

/// back_vertex: the counterpart of each vertex on the back, either the vertex itself or a new vertex
/// numbered from the vertex count on. New vertices are copies of back_copies.
[[nodiscard]] Doubled doubled(const Mesh& mesh, const std::vector<Index>& back_vertex,
                              const std::vector<Index>& back_copies);

/// Reverses the normals of the wedges from `first` on, and the handedness of their tangents.
void turn_wedges(Mesh& mesh, std::size_t first, AttributeChanges& changes);

/// Wedges and their own normals.
using WedgeNormals = std::vector<std::pair<Index, Vec3>>;

/// Adds walls between front and back along the boundary edges of the mesh. Where front and back share
/// vertices, walls are smaller or absent. If the mesh has normals, each wall has separate wedges, listed in
/// `normals`. Returns the number of faces.
std::size_t add_walls(const Mesh& mesh, Doubled& d, WedgeNormals& normals);

/// Sets the normals of wedges, if the mesh has normals.
void set_normals(Mesh& mesh, const WedgeNormals& normals);

} // namespace facetmill

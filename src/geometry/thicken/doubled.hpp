#pragma once
// A surface and its back: what thicken and two-sided have in common.

#include "mesh/lineage.hpp"
#include "mesh/mesh.hpp"

namespace facetmill {

/// The surface and its back, face by face: face f's back is face f + face_count, wedge w's is w +
/// wedge_count.
struct Doubled {
    Mesh mesh;       ///< with wedge_vertex spelled out, without attributes
    Descent descent; ///< complete but for what is added later
};

/// back_vertex says where each vertex is on the back: itself, or one of the new ones, numbered from the
/// vertex count on, which are copies of back_copies.
Doubled doubled(const Mesh& mesh, const std::vector<Index>& back_vertex,
                const std::vector<Index>& back_copies);

/// Turns the normals of the wedges from `first` on, and the handedness of their tangents.
void turn_wedges(Mesh& mesh, std::size_t first, AttributeChanges& changes);

struct OpenEdge {
    Index corner, next, face;
};
/// The edges of one face, by corner.
std::vector<OpenEdge> open_edges(const Mesh& mesh);

} // namespace facetmill

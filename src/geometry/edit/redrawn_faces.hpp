#pragma once
// Builds new faces on the vertices and wedges of a mesh.

#include "mesh/provenance.hpp"

#include <cmath>

namespace facetmill {

/// Whether elements i and j have the same value; NaN equals NaN.
[[nodiscard]] inline bool is_same_value(const Attribute& a, Index i, Index j) {
    for (int k = 0; k < a.components; ++k)
        if (const double x = a.value(i, k), y = a.value(j, k); !(x == y || (std::isnan(x) && std::isnan(y))))
            return false;
    return true;
}

/// A mesh with the vertices and wedges of another, to which faces are added one at a time: append their
/// wedges to mesh.corners, then call end_face. Vertices and wedges may be appended too.
struct RedrawnFaces {
    Mesh mesh; ///< without attributes
    MeshProvenance provenance;

    explicit RedrawnFaces(const Mesh& from) {
        mesh.positions = from.positions;
        mesh.wedge_vertex = from.wedge_vertex;
        mesh.face_offsets.push_back(0);
        provenance.vertices.identity = provenance.wedges.identity = true;
    }
    /// Ends the face of the corners added since the last call. of: their source face in the other mesh.
    void end_face(Index of) {
        mesh.face_offsets.push_back(static_cast<Index>(mesh.corners.size()));
        provenance.faces.push_back(of);
    }
};

} // namespace facetmill

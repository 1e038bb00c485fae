#pragma once
// A face for each vertex, to show where the vertex is.

#include "mesh/mesh.hpp"

#include <algorithm>

namespace facetmill {

/// [vertices] The lowest face at each; none at isolated ones. O(corners).
inline std::vector<Index> faces_at_vertices(const Mesh& mesh) {
    std::vector<Index> faces(mesh.vertex_count(), none);
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            faces[mesh.vertex(c)] = std::min(faces[mesh.vertex(c)], f);
    return faces;
}

} // namespace facetmill

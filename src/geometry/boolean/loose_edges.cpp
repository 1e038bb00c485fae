#include "geometry/boolean/loose_edges.hpp"

#include "geometry/clean/steps.hpp"

namespace facetmill::clean_steps {

LooseEdges::LooseEdges(const Mesh& mesh, const Rings& rings) {
    if (rings.empty()) {
        EdgeTable table = build_edges(mesh);
        offsets_ = std::move(table.corner_offsets);
        corners_ = std::move(table.edge_corners);
        return;
    }
    std::vector<Index> faces;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            if (!rings[mesh.vertex(c)]) {
                faces.push_back(f);
                break;
            }
    const Mesh some = only_faces(mesh, faces);
    std::vector<Index> corner(some.corner_count()); // corners of the full mesh
    for (Index i = 0; i < faces.size(); ++i)
        for (Index k = 0; k < mesh.face_size(faces[i]); ++k)
            corner[some.face_begin(i) + k] = mesh.face_begin(faces[i]) + k;
    const EdgeTable table = build_edges(some);
    const auto face_of = corner_faces(some);
    offsets_.push_back(0);
    for (Index e = 0; e < table.size(); ++e) {
        const auto at = table.corners_of(e);
        const Index from = corner[at[0]], to = corner[next_corner(some, face_of[at[0]], at[0])];
        if (rings[mesh.vertex(from)] && rings[mesh.vertex(to)]) continue; // `some` lacks faces of this edge
        for (const Index c : at) corners_.push_back(corner[c]);
        offsets_.push_back(static_cast<Index>(corners_.size()));
    }
}

Components face_components(const Mesh& mesh, const Rings& rings, const LooseEdges& edges) {
    FaceSets sets(mesh, rings, [](Index) { return true; });
    const std::vector<Index> face_of = edges.size() > 0 ? corner_faces(mesh) : std::vector<Index>{};
    parallel_for(edges.size(), [&](std::size_t e) {
        const auto corners = edges.corners_of(static_cast<Index>(e));
        for (std::size_t i = 1; i < corners.size(); ++i) sets.join(face_of[corners[0]], face_of[corners[i]]);
    });
    Components result;
    result.of_face.resize(mesh.face_count());
    parallel_for(mesh.face_count(),
                 [&](std::size_t f) { result.of_face[f] = sets.find(static_cast<Index>(f)); });
    std::vector<Index> number(sets.bound(), none);
    for (Index& root : result.of_face) {
        Index& n = number[root];
        if (n == none) n = static_cast<Index>(result.count++);
        root = n;
    }
    return result;
}

} // namespace facetmill::clean_steps

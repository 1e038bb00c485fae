#include "geometry/triangulate/triangulate.hpp"

#include "geometry/edit/redrawn_faces.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

using Quad = std::array<Index, 4>; ///< wedges

struct Candidate {
    double worst; ///< the largest |cosine| of a corner: 0 for a rectangle
    Index edge;
};

/// The quad of two triangles at the edge that starts at corner a of the first and at corner b of the second.
/// Its corners are the edge's start, the far corner of the second, the edge's end, the far corner of the
/// first.
Quad quad_of(const Mesh& mesh, const std::vector<Index>& face, Index a, Index b) {
    const Index a1 = next_corner(mesh, face[a], a), a2 = next_corner(mesh, face[a], a1);
    const Index b2 = next_corner(mesh, face[b], next_corner(mesh, face[b], b));
    return {mesh.corners[a], mesh.corners[b2], mesh.corners[a1], mesh.corners[a2]};
}

Vec3 at(const Mesh& mesh, Index wedge) { return mesh.positions[mesh.vertex_of_wedge(wedge)]; }

/// The largest |cosine| of the quad's corners; above 1 if it is bent too much, not convex, or without area.
double worst_corner(const Mesh& mesh, const Quad& q, double min_cosine) {
    const std::array<Vec3, 4> p{at(mesh, q[0]), at(mesh, q[1]), at(mesh, q[2]), at(mesh, q[3])};
    const Vec3 second = cross(p[1] - p[0], p[2] - p[0]), first = cross(p[2] - p[0], p[3] - p[0]);
    const double size = length(first) * length(second);
    if (!(size > 0) || dot(first, second) < min_cosine * size) return 2;
    double worst = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 in = p[i] - p[(i + 3) % 4], out = p[(i + 1) % 4] - p[i];
        if (!(dot(cross(in, out), first + second) > 0)) return 2;
        worst = std::max(worst, std::abs(dot(in, out)) / (length(in) * length(out)));
    }
    return worst;
}

std::vector<Candidate> candidates(const Mesh& mesh, const EdgeTable& edges, const std::vector<Index>& face,
                                  const PairSettings& s) {
    std::vector<Candidate> all(edges.size());
    parallel_for(all.size(), [&](std::size_t i) {
        const auto e = static_cast<Index>(i);
        all[e] = {2, e};
        const auto corners = edges.corners_of(e);
        if (corners.size() != 2) return;
        const Index a = corners[0], b = corners[1], f = face[a], g = face[b];
        if (f == g || mesh.face_size(f) != 3 || mesh.face_size(g) != 3) return;
        if (mesh.corners[a] != mesh.corners[next_corner(mesh, g, b)] ||
            mesh.corners[b] != mesh.corners[next_corner(mesh, f, a)] ||
            mesh.primitive_of(f) != mesh.primitive_of(g))
            return;
        all[e].worst = worst_corner(mesh, quad_of(mesh, face, a, b), s.min_cosine);
    });
    std::erase_if(all, [&](const Candidate& c) { return !(c.worst <= s.cos_corner); });
    std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
        return a.worst != b.worst ? a.worst < b.worst : a.edge < b.edge;
    });
    return all;
}

} // namespace

PairResult pair_triangles(const Mesh& mesh, const PairSettings& settings) {
    const EdgeTable edges = build_edges(mesh);
    const std::vector<Index> face = corner_faces(mesh);
    std::vector<Index> edge_of(mesh.face_count(), none); // [faces] the edge across which the face is merged
    for (const Candidate& c : candidates(mesh, edges, face, settings)) {
        const auto corners = edges.corners_of(c.edge);
        Index &first = edge_of[face[corners[0]]], &second = edge_of[face[corners[1]]];
        if (first == none && second == none) first = second = c.edge;
    }
    PairResult result;
    RedrawnFaces drawn(mesh);
    Mesh& out = drawn.mesh;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (edge_of[f] == none) {
            const auto wedges = mesh.face_wedges(f);
            out.corners.insert(out.corners.end(), wedges.begin(), wedges.end());
            result.triangles += wedges.size() == 3;
        } else {
            const auto corners = edges.corners_of(edge_of[f]);
            if (face[std::min(corners[0], corners[1])] != f) continue; // its earlier partner became the quad
            const Quad q = quad_of(mesh, face, corners[0], corners[1]);
            out.corners.insert(out.corners.end(), q.begin(), q.end());
            ++result.quads;
        }
        drawn.end_face(f);
    }
    normalise_offsets(out);
    result.changes = inherit_attributes(out, mesh, drawn.provenance);
    result.mesh = std::move(out);
    return result;
}

} // namespace facetmill

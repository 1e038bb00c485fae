#include "geometry/edit/t_junctions.hpp"

#include "base/math/predicates.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <optional>

namespace facetmill {

namespace {

/// The boundary edges at each vertex.
struct BoundaryEdgesAt {
    std::vector<std::pair<Index, Index>> by_vertex; ///< sorted pairs of vertex and edge
    explicit BoundaryEdgesAt(const std::vector<BoundaryEdge>& edges) {
        for (Index i = 0; i < edges.size(); ++i) {
            by_vertex.emplace_back(edges[i].from, i);
            by_vertex.emplace_back(edges[i].to, i);
        }
        std::sort(by_vertex.begin(), by_vertex.end());
    }
    template <class Body>
    void each(Index v, Body&& body) const {
        for (auto at = std::lower_bound(by_vertex.begin(), by_vertex.end(), std::pair<Index, Index>{v, 0});
             at != by_vertex.end() && at->first == v; ++at)
            body(at->second);
    }
};

/// The parameter of p on the segment a b, if p is inside it: exactly on it, or within the tolerance and
/// farther from the ends than the tolerance.
std::optional<double> place_on(const Vec3& a, const Vec3& b, const Vec3& p, double tolerance) {
    const Vec3 along = b - a;
    const double t = dot(p - a, along) / dot(along, along);
    if (!(t > 0 && t < 1)) return {};
    if (tolerance > 0) {
        const auto near = [&](const Vec3& q) { return !(length(p - q) > tolerance); };
        if (near(a) || near(b) || !near(a + along * t)) return {};
    } else if (!collinear(a, b, p)) {
        return {};
    }
    return t;
}

bool is_on(const Vec3& a, const Vec3& b, const Vec3& p, double tolerance) {
    if (length(p - a) <= tolerance || length(p - b) <= tolerance) return true;
    return place_on(a, b, p, tolerance).has_value();
}

bool uses(const Mesh& mesh, Index f, Index v) {
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
        if (mesh.vertex(c) == v) return true;
    return false;
}

} // namespace

std::vector<Insertion> find_t_junctions(const Mesh& mesh, double tolerance) {
    const auto& p = mesh.positions;
    const auto boundary = odd_edges(mesh);
    const BoundaryEdgesAt at(boundary);
    std::vector<Index> vertices;
    for (const auto& [v, e] : at.by_vertex)
        if (vertices.empty() || vertices.back() != v) vertices.push_back(v);
    std::vector<Box> boxes(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) boxes[i].add(p[vertices[i]]);
    const BoxTree tree(boxes);
    std::vector<Insertion> insertions;
    for (const BoundaryEdge& edge : boundary) {
        const Vec3 &a = p[edge.from], &b = p[edge.to];
        Box box;
        const Vec3 r{tolerance, tolerance, tolerance};
        for (const Vec3& corner : {a - r, b - r, a + r, b + r}) box.add(corner);
        tree.visit(box, [&](Index i) {
            const Index v = vertices[i];
            if (v == edge.from || v == edge.to || uses(mesh, edge.face, v)) return;
            const auto t = place_on(a, b, p[v], tolerance);
            if (!t) return;
            bool along = false; // a boundary edge of v runs along this edge
            at.each(v, [&](Index e) {
                const Index other = boundary[e].from == v ? boundary[e].to : boundary[e].from;
                along = along || (boundary[e].face != edge.face && is_on(a, b, p[other], tolerance));
            });
            if (along) insertions.push_back({edge.corner, *t, v});
        });
    }
    return insertions;
}

} // namespace facetmill

#include "geometry/self_intersections.hpp"

#include "base/parallel.hpp"
#include "geometry/box_tree.hpp"
#include "geometry/evidence.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;

/// The triangles to test, and the face each belongs to.
struct Facets {
    Mesh mesh;
    std::vector<Index> parent; ///< of a mesh with polygons; empty: triangle i is face i
    std::vector<Box> boxes;    ///< empty for triangles that take no part

    explicit Facets(const Mesh& from) {
        mesh.positions = from.positions;
        mesh.wedge_vertex = from.wedge_vertex;
        mesh.corners = from.corners;
        mesh.face_offsets = from.face_offsets;
        if (!from.all_triangles()) cut();
        boxes.resize(mesh.face_count());
        parallel_for(boxes.size(), [&](std::size_t i) { boxes[i] = box_of_triangle(static_cast<Index>(i)); });
    }

    Index face(Index t) const { return parent.empty() ? t : parent[t]; }
    std::array<Index, 3> vertices(Index t) const {
        return {mesh.vertex(3 * t), mesh.vertex(3 * t + 1), mesh.vertex(3 * t + 2)};
    }
    Point point(Index v) const {
        const Vec3& p = mesh.positions[v];
        return {p.x, p.y, p.z};
    }

  private:
    void cut() {
        std::vector<std::uint32_t> faces(mesh.face_count());
        for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = static_cast<std::uint32_t>(f);
        mesh.attributes = {{"parent", Domain::face, Role::index, 1, false, std::move(faces)}};
        mesh = triangulated(mesh);
        parent = std::get<std::vector<std::uint32_t>>(std::move(mesh.attributes[0].data));
    }

    Box box_of_triangle(Index t) const {
        Box box;
        for (const Index v : vertices(t)) {
            if (!is_finite(mesh.positions[v])) return {};
            box.add(mesh.positions[v]);
        }
        return is_degenerate(mesh, t) ? Box{} : box;
    }
};

/// Brings the vertices of two triangles into step: the shared ones first, in the same order. Returns how
/// many.
int share(std::array<Index, 3>& a, std::array<Index, 3>& b) {
    std::size_t shared = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = shared; j < 3; ++j)
            if (a[i] == b[j]) {
                std::swap(a[i], a[shared]), std::swap(b[j], b[shared]);
                ++shared;
                break;
            }
    return static_cast<int>(shared);
}

/// Whether two triangles with area meet elsewhere than in what they share.
bool meet(const Facets& facets, Index s, Index t) {
    auto a = facets.vertices(s), b = facets.vertices(t);
    const int shared = share(a, b);
    const Point a0 = facets.point(a[0]), a1 = facets.point(a[1]), a2 = facets.point(a[2]);
    if (shared == 3) return true;
    const Point b2 = facets.point(b[2]);
    if (shared == 2) // they hinge on the edge; only folded flat onto each other do they meet elsewhere
        return CGAL::coplanar(a0, a1, a2, b2) && CGAL::coplanar_orientation(a0, a1, a2, b2) == CGAL::POSITIVE;
    const Point b0 = facets.point(b[0]), b1 = facets.point(b[1]);
    const Triangle ta(a0, a1, a2), tb(b0, b1, b2);
    if (shared == 1) // a common point other than the vertex has one on the edge opposite to it in a or b
        return CGAL::do_intersect(Segment(a1, a2), tb) || CGAL::do_intersect(Segment(b1, b2), ta);
    return CGAL::do_intersect(ta, tb);
}

/// The faces that meet face f, found from its triangles [begin, end): those above f, and those below that are
/// not searched themselves.
void find_partners(const Facets& facets, const BoxTree& tree, Index begin, Index end,
                   const std::vector<std::uint8_t>& among, std::vector<Index>& partners) {
    partners.clear();
    for (Index t = begin; t < end; ++t) {
        if (facets.boxes[t].empty()) continue;
        tree.visit(facets.boxes[t], [&](Index other) {
            const Index face = facets.face(other);
            const Index mine = facets.face(t);
            if (face == mine || (face < mine && (among.empty() || among[face]))) return;
            if (meet(facets, t, other)) partners.push_back(face);
        });
    }
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
}

} // namespace

SelfIntersections find_self_intersections(const Mesh& mesh, const SelfIntersectionSettings& settings) {
    const Facets facets(mesh);
    const BoxTree tree(facets.boxes);
    const std::size_t triangles = facets.mesh.face_count();
    return parallel_reduce(
        triangles, SelfIntersections{},
        [&](std::size_t first, std::size_t last) {
            SelfIntersections found;
            std::vector<Index> partners;
            for (auto t = static_cast<Index>(first); t < last;) {
                // A face whose triangles began in the chunk before is that chunk's.
                Index end = t + 1;
                while (end < triangles && facets.face(end) == facets.face(t)) ++end;
                const bool mine = t == 0 || facets.face(t - 1) != facets.face(t);
                if (mine && (settings.among.empty() || settings.among[facets.face(t)])) {
                    find_partners(facets, tree, t, end, settings.among, partners);
                    found.count += partners.size();
                    for (const Index p : partners)
                        if (found.pairs.size() < settings.limit)
                            found.pairs.push_back(std::minmax(facets.face(t), p));
                }
                t = end;
            }
            return found;
        },
        [&](SelfIntersections a, const SelfIntersections& b) {
            a.count += b.count;
            const std::size_t room = settings.limit - a.pairs.size();
            a.pairs.insert(a.pairs.end(), b.pairs.begin(),
                           b.pairs.begin() + static_cast<std::ptrdiff_t>(std::min(room, b.pairs.size())));
            return a;
        },
        1024);
}

} // namespace facetmill

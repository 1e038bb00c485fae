#include "geometry/cgal/triangulate_polygon.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <algorithm>
#include <map>
#include <optional>
#include <type_traits>

namespace facetmill {

namespace {

struct FaceInfo {
    int turns = 0;
    bool known = false;
};

/// The triangulation over a kernel, and names of its parts.
template <class K, class Intersections>
struct Types {
    using Kernel = K;
    using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
    using PlainFaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
    using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel, PlainFaceBase>;
    using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
    using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, Intersections>;
    using Triangulation = CGAL::Constrained_triangulation_plus_2<Delaunay>;
    using Vertex = typename Triangulation::Vertex_handle;
    using Face = typename Triangulation::Face_handle;
    using Constraint = typename Triangulation::Constraint_id;
};

/// Rounds the crossings of edges. Fast, and correct unless a rounded crossing is on the wrong side of a
/// nearby edge; CGAL then loses an edge.
using Rounded = Types<CGAL::Exact_predicates_inexact_constructions_kernel, CGAL::Exact_predicates_tag>;
/// Keeps crossings exact: always correct, and several times slower.
using Exact = Types<CGAL::Exact_predicates_exact_constructions_kernel, CGAL::Exact_intersections_tag>;

std::vector<Index> lowest_at_same_place(const std::vector<Vec2>& points) {
    std::vector<Index> order(points.size()), same(points.size());
    for (Index i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        const Vec2 &p = points[a], &q = points[b];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : a < b;
    });
    for (std::size_t i = 0; i < order.size(); ++i)
        same[order[i]] = i > 0 && points[order[i]] == points[order[i - 1]] ? same[order[i - 1]] : order[i];
    return same;
}

/// Inserts the distinct points, along a Hilbert curve for speed. Returns the vertex of each.
template <class T>
std::vector<typename T::Vertex> insert_points(typename T::Triangulation& t, const std::vector<Vec2>& points,
                                              const std::vector<Index>& same) {
    using Kernel = typename T::Kernel;
    using Item = std::pair<typename Kernel::Point_2, Index>;
    using Traits = CGAL::Spatial_sort_traits_adapter_2<Kernel, CGAL::First_of_pair_property_map<Item>>;
    std::vector<Item> items;
    for (Index i = 0; i < points.size(); ++i)
        if (same[i] == i) items.emplace_back(typename Kernel::Point_2(points[i].x, points[i].y), i);
    CGAL::hilbert_sort(items.begin(), items.end(), Traits());
    std::vector<typename T::Vertex> vertices(points.size());
    typename T::Face near;
    for (const auto& [point, i] : items) {
        vertices[i] = t.insert(point, near);
        near = vertices[i]->face();
    }
    return vertices;
}

template <class T>
class Filler {
    using Triangulation = typename T::Triangulation;
    using Vertex = typename T::Vertex;
    using Face = typename T::Face;
    using Constraint = typename T::Constraint;

  public:
    explicit Filler(const Contours& contours) : in_(contours) {}

    /// Returns none if rounding lost an edge, moved a crossing off its edges, or changed the boundary of the
    /// triangles.
    std::optional<Filling> run() {
        out_.same = lowest_at_same_place(in_.points);
        vertices_ = insert_points<T>(t_, in_.points, out_.same);
        insert_edges();
        number_vertices();
        walk_paths();
        if (lost_) return {};
        if (t_.dimension() < 2) return std::move(out_);
        count_turns();
        emit();
        if (!exact && !out_.added.empty() && !has_right_boundary()) return {};
        return std::move(out_);
    }

  private:
    static constexpr bool exact = std::is_same_v<T, Exact>;

    void insert_edges() {
        constraints_.resize(in_.edges.size());
        std::map<std::pair<Index, Index>, std::optional<Constraint>> seen;
        for (std::size_t e = 0; e < in_.edges.size(); ++e) {
            const Index a = out_.same[in_.edges[e].from], b = out_.same[in_.edges[e].to];
            if (a == b) continue;
            const auto [at, fresh] = seen.try_emplace({std::min(a, b), std::max(a, b)});
            if (fresh)
                at->second = t_.insert_constraint(vertices_[std::min(a, b)], vertices_[std::max(a, b)]);
            constraints_[e] = at->second;
        }
    }

    /// Points that CGAL added where edges cross get the next numbers, in the order in which the edges meet
    /// them.
    void number_vertices() {
        for (auto v = t_.finite_vertices_begin(); v != t_.finite_vertices_end(); ++v) v->info() = none;
        for (Index i = 0; i < vertices_.size(); ++i)
            if (out_.same[i] == i) vertices_[i]->info() = i;
        for (std::size_t e = 0; e < in_.edges.size(); ++e)
            for_path(e, [&](Vertex v) {
                if (v->info() != none) return;
                v->info() = static_cast<Index>(in_.points.size() + out_.added.size());
                const Vec2 at{rounded(v->point().x()), rounded(v->point().y())};
                out_.added.push_back({at, static_cast<Index>(e), parameter(in_.edges[e], at)});
            });
    }

    static double rounded(double x) { return x; }
    template <class Number>
    static double rounded(const Number& x) {
        return CGAL::to_double(
            CGAL::exact(x)); // the double of a lazy number alone would depend on earlier computations
    }

    double parameter(const Contours::Edge& e, const Vec2& at) const {
        const Vec2 &a = in_.points[e.from], &b = in_.points[e.to];
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double t = std::abs(dx) > std::abs(dy) ? (at.x - a.x) / dx : (at.y - a.y) / dy;
        return std::clamp(t, 0.0, 1.0);
    }

    /// Calls body for the vertices along edge e, both ends included, from its from to its to.
    template <class Body>
    void for_path(std::size_t e, Body body) const {
        if (!constraints_[e]) return;
        std::vector<Vertex> all;
        const auto end = t_.vertices_in_constraint_end(*constraints_[e]);
        for (auto v = t_.vertices_in_constraint_begin(*constraints_[e]); v != end; ++v) all.push_back(*v);
        if (all.front() != vertices_[out_.same[in_.edges[e].from]]) std::reverse(all.begin(), all.end());
        for (const Vertex v : all) body(v);
    }

    void walk_paths() {
        out_.path_offsets.push_back(0);
        for (std::size_t e = 0; e < in_.edges.size(); ++e) {
            const Index from = out_.same[in_.edges[e].from], to = out_.same[in_.edges[e].to];
            Index last = from;
            Vertex before;
            for_path(e, [&](Vertex v) {
                lost_ |= before != Vertex() && !t_.is_edge(before, v);
                lost_ |= !exact && v->info() != from && v->info() != to && is_beside(in_.edges[e], v->info());
                before = v;
                const Index i = v->info();
                if (i == last) return;
                along_[{std::min(last, i), std::max(last, i)}] +=
                    last < i ? in_.edges[e].count : -in_.edges[e].count;
                if (i != to) out_.path.push_back(i);
                last = i;
            });
            out_.path_offsets.push_back(static_cast<Index>(out_.path.size()));
        }
    }

    /// Whether a point on the path of an edge is farther from it than the rounding of its coordinates
    /// explains. Rounded crossings of almost parallel edges are off by far more, and beyond the ends.
    bool is_beside(const Contours::Edge& edge, Index point) const {
        const Vec2 &a = in_.points[edge.from], &b = in_.points[edge.to],
                   p = point < in_.points.size() ? in_.points[point]
                                                 : out_.added[point - in_.points.size()].at;
        const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
        const double rounding = 8 * 2.220446049250313e-16 * size;
        const Vec2 d = b - a;
        const double along = dot(d, p - a), length_squared = dot(d, d), slack = rounding * length(d);
        return std::abs(cross(d, p - a)) > slack || along < -slack || along > length_squared + slack;
    }

    /// Whether the triangles end where the contours are, and nowhere else.
    bool has_right_boundary() const {
        std::map<std::pair<Index, Index>, int> left = along_;
        for (const auto& t : out_.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                const Index a = t[i], b = t[(i + 1) % 3];
                left[{std::min(a, b), std::max(a, b)}] -= a < b ? 1 : -1;
            }
        return std::all_of(left.begin(), left.end(), [](const auto& edge) { return edge.second == 0; });
    }

    /// Propagates the number of turns from the outside inwards. It changes by the contours' count at every
    /// crossed edge.
    void count_turns() {
        std::vector<Face> stack{t_.infinite_face()};
        stack.back()->info().known = true;
        while (!stack.empty()) {
            const Face f = stack.back();
            stack.pop_back();
            for (int i = 0; i < 3; ++i) {
                const Face g = f->neighbor(i);
                if (g->info().known) continue;
                // f is left of the edge from a to b, and turns(left) - turns(right) is the count from a to
                // b.
                const Vertex a = f->vertex(Triangulation::ccw(i)), b = f->vertex(Triangulation::cw(i));
                g->info() = {f->info().turns - count_along(a, b), true};
                stack.push_back(g);
            }
        }
    }
    int count_along(Vertex a, Vertex b) const {
        if (t_.is_infinite(a) || t_.is_infinite(b)) return 0;
        const Index i = a->info(), j = b->info();
        const auto it = along_.find({std::min(i, j), std::max(i, j)});
        return it == along_.end() ? 0 : i < j ? it->second : -it->second;
    }

    void emit() {
        for (auto f = t_.finite_faces_begin(); f != t_.finite_faces_end(); ++f) {
            std::array<Index, 3> abc{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
            std::rotate(abc.begin(), std::min_element(abc.begin(), abc.end()), abc.end());
            const int turns = f->info().turns;
            if (turns < 0) std::swap(abc[1], abc[2]);
            for (int i = 0; i < std::abs(turns); ++i) out_.triangles.push_back(abc);
        }
        std::sort(out_.triangles.begin(), out_.triangles.end());
    }

    const Contours& in_;
    bool lost_ = false; ///< the path of an edge is not made of edges of the triangulation
    Filling out_;
    Triangulation t_;
    std::vector<Vertex> vertices_; ///< [points] vertices, set for the lowest point at each position
    std::vector<std::optional<Constraint>>
        constraints_; ///< [edges] constraints; none for an edge between points at the same position
    std::map<std::pair<Index, Index>, int>
        along_; ///< counts of contours by edge (lower vertex, higher vertex)
};

} // namespace

Filling fill(const Contours& contours) {
    if (auto filling = Filler<Rounded>(contours).run()) return std::move(*filling);
    return Filler<Exact>(contours).run().value();
}

} // namespace facetmill

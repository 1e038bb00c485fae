#include "geometry/cgal/triangulate_rings.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>

namespace facetmill::polygon {

namespace {

constexpr int unknown = INT32_MIN;

/// How often the rings run along an edge from its lower vertex to its higher, less how often they run back.
struct Along {
    std::uint64_t key;
    int count;
};

std::uint64_t key_of(Index a, Index b) {
    const auto [low, high] = std::minmax(a, b);
    return std::uint64_t{low} << 32 | high;
}

struct Number {
    Index value = none;
};

template <class Kernel, class Tag>
class Triangulator {
    using Vertex = CGAL::Triangulation_vertex_base_with_info_2<Number, Kernel>;
    using Face =
        CGAL::Triangulation_face_base_with_info_2<int, Kernel,
                                                  CGAL::Constrained_triangulation_face_base_2<Kernel>>;
    using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
    using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, Tag>;
    using Plus = CGAL::Constrained_triangulation_plus_2<Delaunay>;
    using VertexHandle = typename Plus::Vertex_handle;
    using FaceHandle = typename Plus::Face_handle;

  public:
    explicit Triangulator(Rings rings) {
        Index first = 0;
        for (const Ring ring : rings) {
            insert_points(ring, first);
            first += static_cast<Index>(ring.size());
        }
        number_ = first;
        first = 0;
        for (const Ring ring : rings) {
            insert_edges(ring, first);
            first += static_cast<Index>(ring.size());
        }
        gather();
        if (plus_.dimension() == 2) flood();
    }

    Triangulation result() {
        Triangulation out;
        out.added = std::move(added_);
        if (plus_.dimension() < 2) return out;
        for (auto f = plus_.finite_faces_begin(); f != plus_.finite_faces_end(); ++f) {
            if (f->info() == 0) continue;
            std::array<Index, 3> t{number(f->vertex(0)), number(f->vertex(1)), number(f->vertex(2))};
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
            out.triangles.push_back(t);
            out.winding.push_back(f->info());
        }
        return out;
    }

    WindingRange range() const {
        WindingRange r;
        if (plus_.dimension() < 2) return r;
        for (auto f = plus_.finite_faces_begin(); f != plus_.finite_faces_end(); ++f)
            r.least = std::min(r.least, f->info()), r.most = std::max(r.most, f->info());
        return r;
    }

  private:
    static Index number(VertexHandle v) { return v->info().value; }

    void insert_points(Ring ring, Index first) {
        FaceHandle near{};
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const auto before = plus_.number_of_vertices();
            const VertexHandle v = plus_.insert(typename Kernel::Point_2(ring[i].x, ring[i].y), near);
            near = v->face();
            if (plus_.number_of_vertices() != before) v->info().value = first + static_cast<Index>(i);
            handles_.push_back(v);
        }
    }

    void insert_edges(Ring ring, Index first) {
        const std::size_t n = ring.size();
        for (std::size_t i = 0; i < n; ++i) {
            const VertexHandle a = handles_[first + i], b = handles_[first + (i + 1) % n];
            if (a == b) continue;
            constraints_.push_back({plus_.insert_constraint(a, b), a, first + static_cast<Index>(i)});
        }
    }

    /// Numbers the points that crossings added and counts how the rings run along each edge.
    void gather() {
        for (const auto& c : constraints_) {
            std::vector<VertexHandle> path(plus_.vertices_in_constraint_begin(c.id),
                                           plus_.vertices_in_constraint_end(c.id));
            if (path.front() != c.start) std::reverse(path.begin(), path.end());
            for (std::size_t i = 1; i + 1 < path.size(); ++i)
                if (number(path[i]) == none) add_point(path, i, c.edge);
            for (std::size_t i = 0; i + 1 < path.size(); ++i) {
                const Index a = number(path[i]), b = number(path[i + 1]);
                along_.push_back({key_of(a, b), a < b ? 1 : -1});
            }
        }
        std::sort(along_.begin(), along_.end(), [](const Along& a, const Along& b) { return a.key < b.key; });
        std::size_t kept = 0;
        for (const Along& a : along_) {
            if (kept > 0 && along_[kept - 1].key == a.key)
                along_[kept - 1].count += a.count;
            else
                along_[kept++] = a;
        }
        along_.resize(kept);
    }

    void add_point(const std::vector<VertexHandle>& path, std::size_t i, Index edge) {
        const auto at = [](VertexHandle v) {
            return Vec2{CGAL::to_double(v->point().x()), CGAL::to_double(v->point().y())};
        };
        const Vec2 a = at(path.front()), p = at(path[i]), d = at(path.back()) - a;
        path[i]->info().value = number_ + static_cast<Index>(added_.size());
        added_.push_back({p, edge, dot(p - a, d) / dot(d, d)});
    }

    /// How much more often the rings wind around the left of a -> b than around its right.
    int step(Index a, Index b) const {
        const auto key = key_of(a, b);
        const auto at = std::lower_bound(along_.begin(), along_.end(), key,
                                         [](const Along& x, std::uint64_t k) { return x.key < k; });
        if (at == along_.end() || at->key != key) return 0;
        return a < b ? at->count : -at->count;
    }

    void flood() {
        for (auto f = plus_.all_faces_begin(); f != plus_.all_faces_end(); ++f) f->info() = unknown;
        std::vector<FaceHandle> open{plus_.infinite_face()};
        open[0]->info() = 0;
        while (!open.empty()) {
            const FaceHandle f = open.back();
            open.pop_back();
            for (int i = 0; i < 3; ++i) {
                const FaceHandle g = f->neighbor(i);
                if (g->info() != unknown) continue;
                const VertexHandle a = f->vertex(plus_.ccw(i)), b = f->vertex(plus_.cw(i));
                const bool inner = !plus_.is_infinite(a) && !plus_.is_infinite(b) && f->is_constrained(i);
                g->info() = f->info() - (inner ? step(number(a), number(b)) : 0);
                open.push_back(g);
            }
        }
    }

    struct Constraint {
        typename Plus::Constraint_id id;
        VertexHandle start;
        Index edge;
    };
    Plus plus_;
    std::vector<VertexHandle> handles_;
    std::vector<Constraint> constraints_;
    std::vector<Along> along_;
    std::vector<AddedPoint> added_;
    Index number_ = 0;
};

// Where nothing crosses nothing is constructed, and filtered predicates are exact.
using Fast = Triangulator<CGAL::Exact_predicates_inexact_constructions_kernel, CGAL::Exact_predicates_tag>;
using Exact = Triangulator<CGAL::Exact_predicates_exact_constructions_kernel, CGAL::Exact_intersections_tag>;

} // namespace

Triangulation triangulate_rings(Rings rings) {
    return contact(rings) == Contact::crossing ? Exact(rings).result() : Fast(rings).result();
}

WindingRange winding_range(Rings rings) {
    return contact(rings) == Contact::crossing ? Exact(rings).range() : Fast(rings).range();
}

} // namespace facetmill::polygon

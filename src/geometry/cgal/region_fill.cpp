#include "geometry/cgal/region_fill.hpp"

#include "geometry/polygon/certain_triangulation.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace facetmill {

namespace {

using RegionEdge = FlatRegion::Edge;

/// Finds directed edges of a border, and edges along it in either direction.
class RegionBorder {
  public:
    explicit RegionBorder(std::vector<RegionEdge> edges) : directed_(std::move(edges)) {
        std::sort(directed_.begin(), directed_.end());
    }
    bool holds(Index from, Index to) const {
        return std::binary_search(directed_.begin(), directed_.end(), RegionEdge{from, to});
    }
    bool passes(Index a, Index b) const { return holds(a, b) || holds(b, a); }

  private:
    std::vector<RegionEdge> directed_;
};

/// The constrained Delaunay triangulation of a region, in the plane of a kernel.
template <class Kernel>
class RegionFilling {
    using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
    using PlainFaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
    using FaceBase = CGAL::Triangulation_face_base_with_info_2<bool, Kernel, PlainFaceBase>;
    using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
    using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
        Kernel, Structure, CGAL::No_constraint_intersection_requiring_constructions_tag>;
    using Vertex = typename Triangulation::Vertex_handle;
    using Face = typename Triangulation::Face_handle;

  public:
    using Points = std::vector<std::pair<typename Kernel::Point_2, Index>>;

    RegionFilling(const Points& points, const std::vector<RegionEdge>& border,
                  const std::vector<RegionEdge>& lines)
        : count_(points.size()), edges_(border), lines_(lines), border_(border) {
        t_.insert(points.begin(), points.end());
    }

    /// None if points coincide, lines cross or pass through points, or the border does not close.
    std::optional<FlatTriangles> run() {
        if (t_.number_of_vertices() != count_ || t_.dimension() != 2) return {};
        vertices_.resize(count_);
        for (auto v = t_.finite_vertices_begin(); v != t_.finite_vertices_end(); ++v)
            vertices_[v->info()] = v;
        if (!constrain()) return {};
        for (auto f = t_.all_faces_begin(); f != t_.all_faces_end(); ++f) f->info() = false;
        if (!seed() || !spread()) return {};
        return triangles();
    }

  private:
    bool constrain() {
        try {
            for (const auto* edges : {&edges_, &lines_})
                for (const auto& [a, b] : *edges) t_.insert_constraint(vertices_[a], vertices_[b]);
        } catch (const typename Triangulation::Intersection_of_constraints_exception&) {
            return false;
        }
        return std::all_of(lines_.begin(), lines_.end(),
                           [&](const RegionEdge& e) { return t_.is_edge(vertices_[e[0]], vertices_[e[1]]); });
    }

    bool seed() {
        for (const auto& [a, b] : edges_) {
            Face f;
            int i = 0;
            if (!t_.is_edge(vertices_[a], vertices_[b], f, i)) return false;
            enter(f->vertex(Triangulation::ccw(i)) == vertices_[a] ? f : f->neighbor(i));
        }
        return true;
    }
    void enter(Face f) {
        if (std::exchange(f->info(), true)) return;
        open_.push_back(f);
    }

    bool spread() {
        while (!open_.empty()) {
            const Face f = open_.back();
            open_.pop_back();
            if (t_.is_infinite(f)) return false;
            for (int i = 0; i < 3; ++i) {
                const Index a = f->vertex(Triangulation::ccw(i))->info(),
                            b = f->vertex(Triangulation::cw(i))->info();
                if (!f->is_constrained(i) || !border_.passes(a, b))
                    enter(f->neighbor(i));
                else if (!border_.holds(a, b))
                    return false; // on the right of the border
            }
        }
        return true;
    }

    std::optional<FlatTriangles> triangles() const {
        FlatTriangles found;
        std::vector<std::uint8_t> used(count_, 0);
        for (auto f = t_.finite_faces_begin(); f != t_.finite_faces_end(); ++f) {
            if (!f->info()) continue;
            found.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
            for (const Index v : found.back()) used[v] = 1;
        }
        if (std::find(used.begin(), used.end(), 0) != used.end()) return {};
        return found;
    }

    std::size_t count_;
    const std::vector<RegionEdge>& edges_;
    const std::vector<RegionEdge>& lines_;
    RegionBorder border_;
    Triangulation t_;
    std::vector<Vertex> vertices_; ///< vertices of the points
    std::vector<Face> open_;
};

} // namespace

std::array<std::size_t, 3> axes_by(const Vec3& rough_normal) {
    std::array<std::size_t, 3> axes{0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](std::size_t i, std::size_t j) {
        return std::abs(rough_normal[i]) > std::abs(rough_normal[j]);
    });
    return axes;
}

PlaneView view_of(const std::array<Vec3, 3>& corners) {
    const auto& [p, q, r] = corners;
    for (const std::size_t drop : axes_by(cross(q - p, r - p))) {
        const std::size_t u = (drop + 1) % 3, v = (drop + 2) % 3;
        const int way = orientation_2d(p[u], p[v], q[u], q[v], r[u], r[v]);
        if (way != 0) return way > 0 ? PlaneView{u, v} : PlaneView{v, u};
    }
    return {};
}

std::optional<FlatTriangles> proved_filling(const FlatRegion& region,
                                            const std::function<bool(Index, Index, Index)>& is_left) {
    using Quick = CGAL::Exact_predicates_inexact_constructions_kernel;
    double most = 0;
    for (const Vec2& p : region.points) most = std::max({most, std::abs(p.x), std::abs(p.y)});
    if (!(most > 1e-60 && most < 1e60)) return {}; // a product could overflow or underflow
    RegionFilling<Quick>::Points points;
    for (Index i = 0; i < region.points.size(); ++i)
        points.push_back({{region.points[i].x, region.points[i].y}, i});
    auto found = RegionFilling<Quick>(points, region.border, region.lines).run();
    if (!found) return {};
    const auto& at = region.points;
    for (const auto& [a, b, c] : *found)
        if (!polygon::surely_left(at[a], at[b], at[c], most * 0x1p-52) && !is_left(a, b, c)) return {};
    return found;
}

std::optional<FlatTriangles> exact_filling(const FlatRegion& region,
                                           const std::vector<ExactKernel::Point_2>& points) {
    RegionFilling<ExactKernel>::Points numbered;
    for (Index i = 0; i < points.size(); ++i) numbered.push_back({points[i], i});
    return RegionFilling<ExactKernel>(numbered, region.border, region.lines).run();
}

std::optional<FlatTriangles> fill_region(const ExactNodes& nodes, const Arrangement::Region& region) {
    std::vector<Index> here = region.points;
    for (const auto& [a, b] : region.border) here.insert(here.end(), {a, b});
    std::sort(here.begin(), here.end());
    here.erase(std::unique(here.begin(), here.end()), here.end());
    const auto place = [&](Index node) {
        return static_cast<Index>(std::lower_bound(here.begin(), here.end(), node) - here.begin());
    };
    const PlaneView view = view_of(nodes.corners(region.triangle));
    FlatRegion flat;
    for (const Index node : here) flat.points.push_back(view.flat(nodes.rounded(node)));
    for (const auto& [a, b] : region.border) flat.border.push_back({place(a), place(b)});
    const auto exact = [&](Index i) {
        const auto p = nodes.at(here[i]);
        return ExactKernel::Point_2(p[static_cast<int>(view.u)], p[static_cast<int>(view.v)]);
    };
    auto found = proved_filling(
        flat, [&](Index a, Index b, Index c) { return turns_left(exact(a), exact(b), exact(c)); });
    if (!found) {
        std::vector<ExactKernel::Point_2> points;
        for (Index i = 0; i < here.size(); ++i) points.push_back(exact(i));
        found = exact_filling(flat, points);
    }
    if (!found) return {};
    for (auto& triangle : *found) {
        for (Index& corner : triangle) corner = here[corner];
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    }
    std::sort(found->begin(), found->end());
    return found;
}

} // namespace facetmill

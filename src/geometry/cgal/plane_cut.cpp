#include "geometry/cgal/plane_cut.hpp"

#include "base/math/predicates.hpp"
#include "geometry/cgal/region_fill.hpp"
#include "geometry/intersect/plane_crossing.hpp"
#include "geometry/polygon/certain_triangulation.hpp"
#include "parallel/parallel.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <unordered_map>

namespace facetmill {

namespace {

using Sources = std::vector<Arrangement::Source>;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, ExactKernel>;
using PlainFaceBase = CGAL::Constrained_triangulation_face_base_2<ExactKernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<Sources, ExactKernel, PlainFaceBase>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<ExactKernel, Structure, CGAL::Exact_intersections_tag>;
using Triangulation = CGAL::Constrained_triangulation_plus_2<Delaunay>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;
using Constraint = Triangulation::Constraint_id;
using Point2 = ExactKernel::Point_2;
using Point3 = ExactKernel::Point_3;

/// The plane of a triangle, seen along an axis from where the triangle turns left.
class Frame {
  public:
    /// is_level: for each axis, whether all corners have the same coordinate.
    Frame(const Point3& a, const Point3& b, const Point3& c, const Vec3& rough_normal,
          const std::array<bool, 3>& is_level)
        : origin_(a) {
        normal_ = CGAL::cross_product(b - a, c - a);
        const auto axes = axes_by(rough_normal);
        drop_ = static_cast<int>(*std::find_if(axes.begin(), axes.end(), [&](std::size_t i) {
            return !CGAL::is_zero(normal_[static_cast<int>(i)]);
        }));
        is_level_ = is_level[static_cast<std::size_t>(drop_)];
        u_ = (drop_ + 1) % 3;
        v_ = (drop_ + 2) % 3;
        if (CGAL::is_negative(normal_[drop_])) std::swap(u_, v_);
    }

    Point2 flat(const Point3& p) const { return {p[u_], p[v_]}; }
    Point3 lifted(const Point2& p) const {
        std::array<ExactKernel::FT, 3> x;
        x[static_cast<std::size_t>(u_)] = p.x();
        x[static_cast<std::size_t>(v_)] = p.y();
        x[static_cast<std::size_t>(drop_)] = is_level_ ? origin_[drop_] : height(p);
        return {x[0], x[1], x[2]};
    }

  private:
    ExactKernel::FT height(const Point2& p) const {
        const ExactKernel::FT du = p.x() - origin_[u_], dv = p.y() - origin_[v_];
        return origin_[drop_] - (normal_[u_] * du + normal_[v_] * dv) / normal_[drop_];
    }

    Point3 origin_;
    ExactKernel::Vector_3 normal_;
    bool is_level_ = false; ///< the plane is perpendicular to the axis
    int drop_ = 2, u_ = 0, v_ = 1;
};

using Pieces = std::vector<Arrangement::Piece>;
using SideList = std::vector<std::pair<std::pair<Index, Index>, int>>;

/// Cuts a group of a single triangle with floating point only, in the steps of Cutter.
class QuickCutter {
  public:
    QuickCutter(const TriangleSoup& soup, const PlaneGroup& group, const ExactNodes& nodes)
        : group_(group), nodes_(nodes), triangle_(group.triangles.front()),
          corners_(soup.triangles[triangle_]) {}

    /// The first step. False if the result is not certainly correct.
    bool triangulate() {
        if (group_.triangles.size() != 1) return false;
        view_ = view_of(nodes_.corners(triangle_));
        for (const Index n : corners_) add(n);
        for (const Index n : group_.points) add(n);
        for (const Segment& s : group_.segments) {
            const Index from = add(s.from), to = add(s.to);
            cut_.lines.push_back({from, to});
        }
        if (!cross_lines()) return false;
        auto triangles = polygon::certain_triangulation(cut_);
        if (!triangles) triangles = filled();
        if (triangles) triangles_ = std::move(*triangles);
        return triangles.has_value();
    }

    /// Makes nodes of the points where segments cross.
    void name_vertices(ExactNodes& nodes) {
        for (Crossing& c : crossings_)
            here_.push_back(nodes.find_or_add(c.planes, std::move(c.point), c.place));
    }

    void finish(Pieces& pieces, SideList& sides) const {
        for (const auto& [a, b, c] : triangles_) {
            std::array<Index, 3> abc{here_[a], here_[b], here_[c]};
            std::rotate(abc.begin(), std::min_element(abc.begin(), abc.end()), abc.end());
            pieces.push_back({abc, Sources(1, {triangle_, 1})});
        }
        std::sort(pieces.begin(), pieces.end(),
                  [](const auto& a, const auto& b) { return a.nodes < b.nodes; });
        for (std::size_t i = 3; i < here_.size(); ++i)
            for (int k = 0; k < 3; ++k)
                if (cut_.sides[i] >> k & 1) sides.push_back({{triangle_, here_[i]}, k});
    }

  private:
    struct Crossing {
        PlaneTriple planes;
        std::optional<ExactNodes::Point> point; ///< set if the position was computed from it
        Vec3 place;
    };

    Index add(Index node) {
        const auto place = static_cast<Index>(here_.size());
        constexpr std::size_t few = 32; // up to this many are found as fast without the map
        if (here_.size() < few) {
            const auto known = std::find(here_.begin(), here_.end(), node);
            if (known != here_.end()) return static_cast<Index>(known - here_.begin());
        } else {
            if (here_.size() == few)
                for (Index i = 0; i < place; ++i) place_of_.emplace(here_[i], i);
            const auto [known, fresh] = place_of_.try_emplace(node, place);
            if (!fresh) return known->second;
        }
        add_point(nodes_.rounded(node), sides_of(node));
        here_.push_back(node);
        return place;
    }
    void add_point(const Vec3& p, std::uint8_t sides) {
        cut_.points.push_back(view_.flat(p));
        cut_.sides.push_back(sides);
    }
    /// The sides that contain the node, which must be in the triangle.
    std::uint8_t sides_of(Index node) const {
        const SideCrossing made = nodes_.crossing_of(node);
        unsigned found = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index from = corners_[k], to = corners_[(k + 1) % 3];
            const auto [low, high] = std::minmax(from, to);
            if (node == low || node == high || (made.low == low && made.high == high) ||
                (!is_surely_beside(from, to, node) && !is_left(from, to, node)))
                found |= 1u << k;
        }
        return static_cast<std::uint8_t>(found);
    }
    bool is_surely_beside(Index from, Index to, Index node) const {
        const auto at = [&](Index n) { return view_.flat(nodes_.rounded(n)); };
        double most = 0;
        for (const Index n : corners_) most = std::max({most, std::abs(at(n).x), std::abs(at(n).y)});
        return most > 1e-60 && most < 1e60 &&
               polygon::surely_left(at(from), at(to), at(node), most * 0x1p-52);
    }
    Point2 exact(Index node) const {
        const auto p = nodes_.at(node);
        return {p[static_cast<int>(view_.u)], p[static_cast<int>(view_.v)]};
    }
    bool is_left(Index a, Index b, Index c) const { return turns_left(exact(a), exact(b), exact(c)); }

    /// The triangulation, for any number of points.
    std::optional<FlatTriangles> filled() const {
        auto border = polygon::certain_border(cut_);
        if (!border) return {};
        FlatRegion region{cut_.points, std::move(*border), {}};
        for (const auto& [a, b] : cut_.lines)
            if (!(cut_.sides[a] & cut_.sides[b])) region.lines.push_back({a, b});
        auto found = proved_filling(region, [&](Index a, Index b, Index c) {
            if (std::max({a, b, c}) >= here_.size()) return false; // where segments cross
            return is_left(here_[a], here_[b], here_[c]);
        });
        if (found || !crossings_.empty()) return found;
        std::vector<Point2> points;
        for (const Index node : here_) points.push_back(exact(node));
        return exact_filling(region, points);
    }

    /// Divides lines where they cross. False if uncertain.
    bool cross_lines() {
        const auto pairs = polygon::certain_crossings(cut_);
        if (!pairs) return false;
        if (pairs->empty()) return true;
        std::vector<std::vector<Index>> on_line(cut_.lines.size());
        for (const auto& [i, j] : *pairs) {
            const auto at = static_cast<Index>(cut_.points.size());
            const Crossing& c = crossings_.emplace_back(crossing_of(i, j));
            add_point(c.place, 0);
            on_line[i].push_back(at);
            on_line[j].push_back(at);
        }
        std::vector<std::array<Index, 2>> parts;
        for (std::size_t i = 0; i < on_line.size(); ++i) {
            auto [at, end] = cut_.lines[i];
            const Vec2 from = cut_.points[at], way = cut_.points[end] - from;
            std::sort(on_line[i].begin(), on_line[i].end(), [&](Index a, Index b) {
                return dot(cut_.points[a] - from, way) < dot(cut_.points[b] - from, way);
            });
            for (const Index next : on_line[i]) {
                parts.push_back({at, next});
                at = next;
            }
            parts.push_back({at, end});
        }
        cut_.lines = std::move(parts);
        return true;
    }
    Crossing crossing_of(Index i, Index j) const {
        PlaneTriple planes{triangle_, group_.segments[i].across, group_.segments[j].across};
        std::sort(planes.begin(), planes.end());
        if (const auto place = planes_crossing(
                {nodes_.corners(planes[0]), nodes_.corners(planes[1]), nodes_.corners(planes[2])}))
            return {planes, {}, *place};
        auto point = nodes_.point_of(planes);
        const Vec3 place = ExactNodes::place_of(point);
        return {planes, std::move(point), place};
    }

    const PlaneGroup& group_;
    const ExactNodes& nodes_;
    Index triangle_;
    std::array<Index, 3> corners_;
    PlaneView view_;
    polygon::CutTriangle cut_;
    std::vector<std::array<Index, 3>> triangles_; ///< [local points] triangles
    std::vector<Index> here_;                     ///< [local points] nodes
    std::unordered_map<Index, Index> place_of_;   ///< index in here_, used if there are many nodes
    std::vector<Crossing> crossings_;             ///< local points after those nodes, until they are named
};

/// Cuts a group in three steps. Only the second step changes shared data.
class Cutter {
  public:
    /// The first step: triangulates.
    Cutter(const TriangleSoup& soup, const PlaneGroup& group, const ExactNodes& nodes)
        : soup_(soup), group_(group), nodes_(nodes), frame_(frame_of(group.triangles.front())) {
        for (const Index t : group_.triangles)
            for (const Index p : soup_.triangles[t]) vertex_of(p);
        for (const Index p : group_.points) vertex_of(p);
        for (const Segment& s : group_.segments) {
            vertex_of(s.from);
            vertex_of(s.to);
        }
        for (const Index t : group_.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                constrain(soup_.triangles[t][i], soup_.triangles[t][(i + 1) % 3]);
        for (const Segment& s : group_.segments) constrain(s.from, s.to);
    }

    /// Makes nodes of the points where segments crossed.
    void name_vertices(ExactNodes& nodes) {
        for (auto v = t_.finite_vertices_begin(); v != t_.finite_vertices_end(); ++v) v->info() = none;
        for (const auto& [node, v] : vertices_) v->info() = node;
        if (vertices_.size() == t_.number_of_vertices()) return;
        for (auto v = t_.finite_vertices_begin(); v != t_.finite_vertices_end(); ++v)
            if (v->info() == none) v->info() = nodes.find_or_add(frame_.lifted(v->point()));
    }

    void finish(Pieces& pieces, SideList& sides) const {
        for (const Index t : group_.triangles) spread(t, sides);
        emit(pieces);
    }

  private:
    Frame frame_of(Index t) const {
        const auto& [a, b, c] = soup_.triangles[t];
        const Vec3 &p = soup_.points[a], &q = soup_.points[b], &r = soup_.points[c];
        std::array<bool, 3> across{};
        for (std::size_t k = 0; k < 3; ++k) across[k] = is_level(p, q, r, k);
        return {nodes_.at(a), nodes_.at(b), nodes_.at(c), cross(q - p, r - p), across};
    }

    Vertex vertex_of(Index node) {
        const auto [at, fresh] = vertices_.try_emplace(node);
        if (fresh) at->second = t_.insert(frame_.flat(nodes_.at(node)));
        return at->second;
    }

    void constrain(Index a, Index b) {
        const auto [at, fresh] = constraints_.try_emplace(std::minmax({a, b}));
        if (fresh)
            at->second = t_.insert_constraint(vertices_.at(at->first.first), vertices_.at(at->first.second));
    }

    /// The vertices along a side of a triangle, from its first corner to its second.
    std::vector<Vertex> path(Index from, Index to) const {
        const Constraint c = constraints_.at(std::minmax({from, to}));
        std::vector<Vertex> all;
        for (auto v = t_.vertices_in_constraint_begin(c); v != t_.vertices_in_constraint_end(c); ++v)
            all.push_back(*v);
        if (all.front()->info() != from) std::reverse(all.begin(), all.end());
        return all;
    }

    /// The triangle left of the edge from p to q.
    Face left_of(Vertex p, Vertex q) const {
        Face f;
        int i = 0;
        t_.is_edge(p, q, f, i);
        return f->vertex(Triangulation::ccw(i)) == p ? f : f->neighbor(i);
    }

    /// Assigns the faces within triangle t to it.
    void spread(Index t, SideList& sides) const {
        const auto& corners = soup_.triangles[t];
        const auto flat = [&](std::size_t i) { return vertices_.at(corners[i])->point(); };
        const bool left = CGAL::orientation(flat(0), flat(1), flat(2)) == CGAL::LEFT_TURN;
        std::set<std::pair<Index, Index>> border;
        std::vector<Face> stack;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto along = path(corners[i], corners[(i + 1) % 3]);
            for (std::size_t k = 0; k + 1 < along.size(); ++k) {
                border.insert(std::minmax({along[k]->info(), along[k + 1]->info()}));
                stack.push_back(left ? left_of(along[k], along[k + 1]) : left_of(along[k + 1], along[k]));
                if (k > 0) sides.push_back({{t, along[k]->info()}, static_cast<int>(i)});
            }
        }
        while (!stack.empty()) {
            const Face f = stack.back();
            stack.pop_back();
            if (!f->info().empty() && f->info().back().triangle == t) continue;
            f->info().push_back({t, left ? 1 : -1});
            for (int i = 0; i < 3; ++i) {
                const Index a = f->vertex(Triangulation::ccw(i))->info(),
                            b = f->vertex(Triangulation::cw(i))->info();
                if (!border.contains(std::minmax({a, b}))) stack.push_back(f->neighbor(i));
            }
        }
    }

    void emit(Pieces& pieces) const {
        const auto first = static_cast<std::ptrdiff_t>(pieces.size());
        for (auto f = t_.finite_faces_begin(); f != t_.finite_faces_end(); ++f) {
            if (f->info().empty()) continue;
            std::array<Index, 3> abc{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
            std::rotate(abc.begin(), std::min_element(abc.begin(), abc.end()), abc.end());
            pieces.push_back({abc, f->info()});
        }
        std::sort(pieces.begin() + first, pieces.end(),
                  [](const auto& a, const auto& b) { return a.nodes < b.nodes; });
    }

    const TriangleSoup& soup_;
    const PlaneGroup& group_;
    const ExactNodes& nodes_;
    Frame frame_;
    Triangulation t_;
    std::map<Index, Vertex> vertices_; ///< vertices of the given nodes
    std::map<std::pair<Index, Index>, Constraint> constraints_;
};

} // namespace

void cut_in_planes(const TriangleSoup& soup, const std::vector<PlaneGroup>& groups, ExactNodes& nodes,
                   std::vector<Arrangement::Piece>& pieces, SidesOfNodes& sides) {
    constexpr std::size_t together = 4096, few = 16; // this many are in memory at a time
    for (std::size_t begin = 0; begin < groups.size(); begin += together) {
        const std::size_t count = std::min(together, groups.size() - begin);
        std::vector<std::unique_ptr<QuickCutter>> quick(count);
        std::vector<std::unique_ptr<Cutter>> cutters(count); // cutters of the other groups
        std::vector<Pieces> of_each(count);
        std::vector<SideList> sides_of_each(count);
        parallel_for(
            count,
            [&](std::size_t i) {
                const PlaneGroup& group = groups[begin + i];
                quick[i] = std::make_unique<QuickCutter>(soup, group, nodes);
                if (quick[i]->triangulate()) return;
                quick[i].reset();
                cutters[i] = std::make_unique<Cutter>(soup, group, nodes);
            },
            few);
        for (std::size_t i = 0; i < count; ++i)
            quick[i] ? quick[i]->name_vertices(nodes) : cutters[i]->name_vertices(nodes);
        parallel_for(
            count,
            [&](std::size_t i) {
                if (quick[i])
                    quick[i]->finish(of_each[i], sides_of_each[i]);
                else
                    cutters[i]->finish(of_each[i], sides_of_each[i]);
                quick[i].reset();
                cutters[i].reset();
            },
            few);
        for (std::size_t i = 0; i < count; ++i) {
            std::move(of_each[i].begin(), of_each[i].end(), std::back_inserter(pieces));
            for (const auto& [at, side] : sides_of_each[i]) sides[at] = side;
        }
    }
}

} // namespace facetmill

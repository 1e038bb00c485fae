// The thickness of the walls of a solid, from all points of its faces.
#include "geometry/inspect/measures.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "geometry/spatial/rays_walk.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/face.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <tuple>

namespace facetmill::inspect_room {

namespace {

/// The distance along d, of length 1, from p to a triangle that the ray meets. The result is limited to the
/// corners' distances, because rounding may cancel the angle of a grazing ray.
double meets_at(const Vec3& p, const Vec3& d, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = cross(b - a, c - a);
    const auto [least, most] = std::minmax({dot(a - p, d), dot(b - p, d), dot(c - p, d)});
    const double facing = dot(n, d);
    return facing > 0 ? std::clamp(dot(n, a - p) / facing, least, most) : least;
}

/// Rays from the centres of faces along their inward normals.
class CentreRays {
  public:
    CentreRays(const Mesh& mesh, const Surface& surface) : mesh_(mesh), tree_(surface, FaceTree::Use::rays) {}

    /// The distance to where the ray leaves the solid, at any angle, if it is less than `most`.
    double distance(Index face, double most) const {
        const Vec3 d = -normalised(area_vector(mesh_, face)), p = corner_mean(mesh_, face);
        if (!(dot(d, d) > 0) || !is_finite(p)) return most;
        const Line line{p, p + d, true};
        // Exact, so that a ray does not slip through between two faces at an edge.
        const rays::LineSigns signs(line.from, line.to);
        rays::LineWalk walk(tree_, line, most);
        while (walk.step([&](Index t) {
            if (tree_.face(t) == face) return most;
            const auto [a, b, c] = tree_.triangle(t);
            if (signs.passes(a, b, c) != 1) return most; // it does not leave through the front
            const double at = meets_at(p, d, a, b, c);
            if (at >= 0) most = std::min(most, at);
            return most;
        })) {
        }
        return most;
    }

  private:
    const Mesh& mesh_;
    FaceTree tree_;
};

constexpr double half_right_angle = 0.70710678118654752; // its sine and cosine

/// A point of the view along a direction, with its depth.
struct Seen {
    double u, v, depth;
};

/// Convex polygons seen along a direction, cut off by lines. A triangle cut by four has at most 7 corners.
class SeenPolygon {
  public:
    void add(const Seen& p) { points_[size_++] = p; }
    /// Keeps the points at which side is not negative. side must be linear.
    template <class Side>
    void cut(Side&& side) {
        const SeenPolygon before = *this;
        size_ = 0;
        for (std::size_t i = 0; i < before.size_; ++i) {
            const Seen &p = before.points_[i], &q = before.points_[(i + 1) % before.size_];
            const double at_p = side(p), at_q = side(q);
            if (at_p >= 0) add(p);
            if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
                const double t = at_p / (at_p - at_q);
                add({p.u + t * (q.u - p.u), p.v + t * (q.v - p.v), p.depth + t * (q.depth - p.depth)});
            }
        }
    }
    bool empty() const { return size_ == 0; }
    double nearest() const {
        double least = HUGE_VAL;
        for (std::size_t i = 0; i < size_; ++i) least = std::min(least, points_[i].depth);
        return least;
    }
    double farthest() const {
        double most = -HUGE_VAL;
        for (std::size_t i = 0; i < size_; ++i) most = std::max(most, points_[i].depth);
        return most;
    }

  private:
    std::array<Seen, 8> points_;
    std::size_t size_ = 0;
};

/// The view from a triangle along its inward normal.
class View {
  public:
    View(const Surface& surface, Index triangle, const Vec3& normal)
        : d(-normal), origin_(surface.point(triangle, 0)) {
        Vec3 longest;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 side = surface.point(triangle, (k + 1) % 3) - surface.point(triangle, k);
            if (dot(side, side) > dot(longest, longest)) longest = side;
        }
        u_ = normalised(longest);
        v_ = cross(normal, u_);
        for (std::size_t k = 0; k < 3; ++k) {
            frame_[k] = of(surface.point(triangle, k));
            triangle_.add(surface.point(triangle, k));
        }
        std::tie(low_.u, high_.u) = std::minmax({frame_[0].u, frame_[1].u, frame_[2].u});
        std::tie(low_.v, high_.v) = std::minmax({frame_[0].v, frame_[1].v, frame_[2].v});
    }
    /// The bounds of the points behind the triangle within a distance, with a margin.
    Box bounds(double distance, double margin) const {
        Box all = triangle_;
        for (const Vec3& p : {triangle_.min, triangle_.max}) all.add(p + d * distance);
        const Vec3 more{margin, margin, margin};
        return {all.min - more, all.max + more};
    }
    /// False only if no point of the box is behind the triangle within a distance.
    bool may_meet(const Box& box, double distance, double slack) const {
        const Vec3 half = box.extent() * 0.5, to = box.centre() - origin_;
        const auto reach = [&](const Vec3& axis) {
            return std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z + slack;
        };
        const auto overlaps = [&](const Vec3& axis, double low, double high) {
            const double at = dot(to, axis), about = reach(axis);
            return at + about >= low && at - about <= high;
        };
        return overlaps(u_, low_.u, high_.u) && overlaps(v_, low_.v, high_.v) && overlaps(d, 0, distance);
    }
    Seen of(const Vec3& p) const {
        const Vec3 to = p - origin_;
        return {dot(to, u_), dot(to, v_), dot(to, d)};
    }
    /// Cuts off the parts outside the triangle's prism, and the parts in front of it.
    void cut(SeenPolygon& polygon) const {
        for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
            const Seen &a = frame_[k], &b = frame_[(k + 1) % 3];
            polygon.cut([&](const Seen& p) { return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u); });
        }
        if (!polygon.empty()) polygon.cut([](const Seen& p) { return p.depth; });
    }

    const Vec3 d; ///< inward

  private:
    Vec3 origin_, u_, v_;
    std::array<Seen, 3> frame_;
    Seen low_{}, high_{}; ///< of the triangle
    Box triangle_;
};

/// Triangles with their normals and neighbours.
class Walls {
  public:
    explicit Walls(const Surface& surface)
        : surface_(surface), mesh_(triangles_of_surface(surface)), edges_(build_edges(mesh_)),
          corners_(corners_at_vertices(mesh_)), normals_(surface.size()), tree_(boxes()),
          size_(surface.bounds().diagonal()) {}

    /// The least distance from the triangle's points, if it is less than `most`.
    double thinnest(Index t, double most) const {
        if (normals_[t] == Vec3{}) return most;
        const View view(surface_, t, normals_[t]);
        const double slack = 1e-9 * size_;
        // This skips most boxes in fewer steps.
        const Box bounds = view.bounds(std::min(most, size_), slack);
        const auto may_meet = [&](const Box& box) {
            return boxes_meet(box, bounds) && view.may_meet(box, most, slack);
        };
        tree_.any_where(may_meet, [&](Index other) {
            if (other != t) most = std::min(most, nearest(view, other, most));
            return false;
        });
        return most;
    }

  private:
    static Mesh triangles_of_surface(const Surface& surface) {
        Mesh mesh;
        mesh.positions = surface.positions;
        mesh.corners = surface.corners;
        return mesh;
    }
    /// Also finds the normals. Needles get none, because rounding would decide where they face; neighbouring
    /// faces contain their points.
    std::vector<Box> boxes() {
        std::vector<Box> all(surface_.size());
        parallel_for(all.size(), [&](std::size_t t) {
            const Vec3 &a = surface_.point(t, 0), &b = surface_.point(t, 1), &c = surface_.point(t, 2);
            const Vec3 n = cross(b - a, c - a);
            const double longest = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
            if (!(length(n) > 1e-6 * longest) || !(longest < HUGE_VAL)) return;
            normals_[t] = normalised(n);
            for (const Vec3* p : {&a, &b, &c}) all[t].add(*p);
        });
        return all;
    }

    double nearest(const View& view, Index other, double most) const {
        const double facing = dot(normals_[other], view.d);
        if (!(facing > 0)) return most;
        std::array<Seen, 3> seen;
        for (std::size_t k = 0; k < 3; ++k) seen[k] = view.of(surface_.point(other, k));
        const auto [low, high] = std::minmax({seen[0].depth, seen[1].depth, seen[2].depth});
        if (low >= most || !(high > rounding())) return most;
        if (facing >= half_right_angle) return std::min(most, distance(view, seen));
        for (std::size_t k = 0; k < 3; ++k) {
            if (is_bottom_edge(view.d, other, k))
                most = std::min(most, distance(view, std::array{seen[k], seen[(k + 1) % 3]}));
            if (seen[k].depth > rounding() && seen[k].depth < most &&
                is_bottom_vertex(view.d, surface_.corners[3 * std::size_t{other} + k]))
                most = std::min(most, distance(view, std::array{seen[k]}));
        }
        return most;
    }
    double rounding() const { return 1e-12 * size_; }

    /// The distance along d to the nearest part of a polygon behind the triangle. Polygons in the triangle's
    /// plane are neighbours that face away.
    template <std::size_t N>
    double distance(const View& view, const std::array<Seen, N>& points) const {
        SeenPolygon polygon;
        for (const Seen& p : points) polygon.add(p);
        view.cut(polygon);
        return polygon.farthest() > rounding() ? std::max(0.0, polygon.nearest()) : HUGE_VAL;
    }

    /// Whether the edge is the bottom of a groove as seen along d: it is reflex, and between the normals of
    /// its faces is one within 45 degrees of d.
    bool is_bottom_edge(const Vec3& d, Index triangle, std::size_t k) const {
        const Index corner = 3 * triangle + static_cast<Index>(k), e = edges_.corner_edge[corner];
        if (e == none || edges_.corners_of(e).size() != 2) return false;
        const auto corners = edges_.corners_of(e);
        const Index other = (corners[0] == corner ? corners[1] : corners[0]) / 3;
        const Vec3 &a = normals_[triangle], &b = normals_[other];
        const Vec3& from = mesh_.point(corner);
        const Vec3 along = normalised(mesh_.point(next_corner(mesh_, triangle, corner)) - from);
        const double turn = dot(cross(a, b), along);
        if (!(turn < 0)) return false; // convex or flat
        const double slope = dot(d, along);
        if (std::abs(slope) > half_right_angle) return false;
        const Vec3 across = d - along * slope;
        return dot(cross(a, across), along) <= 0 && dot(cross(across, b), along) <= 0;
    }
    /// Whether the vertex is the bottom of a pit: all its faces face d and rise from it.
    bool is_bottom_vertex(const Vec3& d, Index v) const {
        const auto corners = corners_.of(v);
        return std::all_of(corners.begin(), corners.end(), [&](Index c) {
            const Index t = c / 3;
            if (!(dot(normals_[t], d) >= 0)) return false;
            for (std::size_t k = 0; k < 3; ++k)
                if (!(dot(surface_.point(t, k) - mesh_.positions[v], d) >= 0)) return false;
            return true;
        });
    }

    const Surface& surface_;
    Mesh mesh_; ///< the triangles
    EdgeTable edges_;
    VertexLists corners_;
    std::vector<Vec3> normals_; ///< unit vectors, or 0
    BoxTree tree_;
    double size_ = 0;
};

} // namespace

std::vector<double> wall_thicknesses(const Mesh& mesh) {
    const Surface surface = filled_surface(mesh);
    std::vector<double> ways(mesh.face_count());
    const CentreRays rays(mesh, surface);
    parallel_for(
        ways.size(), [&](std::size_t f) { ways[f] = rays.distance(static_cast<Index>(f), HUGE_VAL); }, 256);
    const Walls walls(surface);
    std::vector<double> of_triangle(surface.size());
    parallel_for(
        of_triangle.size(),
        [&](std::size_t t) { of_triangle[t] = walls.thinnest(static_cast<Index>(t), ways[surface.face(t)]); },
        256);
    for (std::size_t t = 0; t < of_triangle.size(); ++t)
        ways[surface.face(t)] = std::min(ways[surface.face(t)], of_triangle[t]);
    return ways;
}

namespace {

/// The least value so far, which all threads share as the bound of their searches. The last one does not
/// depend on their order.
class SharedLeast {
  public:
    double get() const { return least_.load(std::memory_order_relaxed); }
    void offer(double x) {
        double old = get();
        while (x < old && !least_.compare_exchange_weak(old, x, std::memory_order_relaxed)) {
        }
    }

  private:
    std::atomic<double> least_ = HUGE_VAL;
};

double least_thickness(const Mesh& mesh) {
    const Surface surface = filled_surface(mesh);
    SharedLeast least;
    const CentreRays rays(mesh, surface);
    parallel_for(
        mesh.face_count(),
        [&](std::size_t f) { least.offer(rays.distance(static_cast<Index>(f), HUGE_VAL)); }, 256);
    const Walls walls(surface);
    parallel_for(
        surface.size(),
        [&](std::size_t t) { least.offer(walls.thinnest(static_cast<Index>(t), least.get())); }, 256);
    return least.get();
}

} // namespace

std::optional<double> thinnest_wall(const Measured& mesh) {
    const PowerScale scale = even_scale(mesh.world.bounds());
    const double least = least_thickness(scale.none() ? mesh.world : scale(mesh.world));
    if (least == HUGE_VAL) return {};
    return scale.none() ? least : unscaled(least, scale.powers[0]);
}

} // namespace facetmill::inspect_room

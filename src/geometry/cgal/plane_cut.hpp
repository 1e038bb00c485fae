#pragma once
// Cuts triangles of the same plane along segments and along each other. Only for this folder.

#include "base/math/predicates.hpp"
#include "base/math/random.hpp"
#include "geometry/cgal/arrangement.hpp"
#include "mesh/mesh.hpp"
#include "mesh/position_hash.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <algorithm>
#include <array>
#include <bit>
#include <compare>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

namespace facetmill {

/// A hash of pairs and triples of numbers.
struct HashOfIndices {
    template <class Indices>
    std::size_t operator()(const Indices& indices) const {
        std::uint64_t hash = 0;
        std::apply([&](auto... i) { ((hash = hashed(hash, i)), ...); }, indices);
        return hash;
    }
};

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;

/// The intersection of the side between two points and the plane of a triangle.
struct SideCrossing {
    Index low = none, high = none, triangle = none;
};

/// Three triangles, ascending, whose planes have a single common point.
using PlaneTriple = std::array<Index, 3>;

/// The given points, followed by constructed points: where sides cross triangles, or three planes meet.
/// Exact coordinates are computed on request, because doubles suffice for most points.
class ExactNodes {
  public:
    using Point = ExactKernel::Point_3;

    explicit ExactNodes(const TriangleSoup& soup) : soup_(soup), points_(soup.points) {}

    /// From now on, a constructed point at the position of this point is this point.
    void know(Index point) {
        auto& here = at_place_[place_hash(points_[point])];
        for (const Index other : here)
            if (other == point) return;
        here.push_back(point);
    }
    /// The rounded position of p. The double of a lazy number alone would depend on earlier computations.
    static Vec3 place_of(const Point& p) { return {nearest(p.x()), nearest(p.y()), nearest(p.z())}; }
    Index find_or_add(const Point& p) { return find_or_add(SideCrossing{}, p, place_of(p)); }
    /// The point of a crossing at its position; the exact point may be missing.
    Index find_or_add(const SideCrossing& crossing, std::optional<Point> p, const Vec3& place) {
        auto& here = at_place_[place_hash(place)];
        for (const Index other : here) {
            if (rounded(other) != place) continue;
            if (!p) p = point_of(crossing);
            if (at(other) == *p) return other;
        }
        return add(here, Made(crossing, {none, none, none}, std::move(p)), place);
    }
    /// Like the previous function, for the common point of three planes.
    Index find_or_add(const PlaneTriple& planes, std::optional<Point> p, const Vec3& place) {
        const auto [known, fresh] = of_planes_.try_emplace(planes, none);
        if (!fresh) return known->second;
        auto& here = at_place_[place_hash(place)];
        for (const Index other : here) {
            if (rounded(other) != place) continue;
            if (!p) p = point_of(planes);
            if (at(other) == *p) return known->second = other;
        }
        return known->second = add(here, Made({}, planes, std::move(p)), place);
    }
    Point point_of(const PlaneTriple& planes) const {
        std::array<ExactKernel::Vector_3, 3> normal;
        std::array<ExactKernel::FT, 3> height;
        const Point origin = at(soup_.triangles[planes[0]][0]);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& [a, b, c] = soup_.triangles[planes[i]];
            const Point from = at(a);
            normal[i] = CGAL::cross_product(at(b) - from, at(c) - from);
            height[i] = normal[i] * (from - origin);
        }
        const auto way = height[1] * CGAL::cross_product(normal[2], normal[0]) +
                         height[2] * CGAL::cross_product(normal[0], normal[1]);
        const ExactKernel::FT whole = normal[0] * CGAL::cross_product(normal[1], normal[2]);
        std::array<ExactKernel::FT, 3> x{origin.x() + way.x() / whole, origin.y() + way.y() / whole,
                                         origin.z() + way.z() / whole};
        for (const Index t : planes) // for a plane perpendicular to an axis, no number needs to be computed
            for (std::size_t k = 0; k < 3; ++k)
                if (const auto there = level(t, k)) x[k] = *there;
        return {x[0], x[1], x[2]};
    }
    /// The coordinate along an axis, if all corners of the triangle have the same.
    std::optional<double> level(Index triangle, std::size_t axis) const {
        const auto& [a, b, c] = soup_.triangles[triangle];
        const double x = points_[a][axis];
        return x == points_[b][axis] && x == points_[c][axis] ? std::optional(x) : std::nullopt;
    }
    std::array<Vec3, 3> corners(Index triangle) const {
        const auto& [a, b, c] = soup_.triangles[triangle];
        return {points_[a], points_[b], points_[c]};
    }
    Point point_of(const SideCrossing& crossing) const {
        if (const auto plain = plain_point_of(crossing)) return *plain;
        const Point p = at(crossing.low), q = at(crossing.high);
        const auto& corner = soup_.triangles[crossing.triangle];
        const Point o = at(corner[0]);
        const auto normal = CGAL::cross_product(at(corner[1]) - o, at(corner[2]) - o);
        const ExactKernel::FT above = normal * (p - o), below = normal * (q - o);
        return p + (above / (above - below)) * (q - p);
    }
    /// The crossing that made a node; empty for given points and others.
    SideCrossing crossing_of(Index node) const {
        return node < points_.size() ? SideCrossing{} : made_[node - points_.size()].crossing;
    }

    std::size_t size() const { return points_.size() + made_.size(); }
    Point at(Index node) const {
        if (node >= points_.size()) return point_of(made_[node - points_.size()]);
        const Vec3& p = points_[node];
        return {p.x, p.y, p.z};
    }
    const Vec3& rounded(Index node) const {
        return node < points_.size() ? points_[node] : rounded_[node - points_.size()];
    }

  private:
    struct Made {
        Made(const SideCrossing& of, const PlaneTriple& where, std::optional<Point> p)
            : crossing(of), planes(where), point(std::move(p)) {}
        Made(Made&& other) noexcept
            : crossing(other.crossing), planes(other.planes), point(std::move(other.point)) {}
        SideCrossing crossing;
        PlaneTriple planes;          ///< the three planes, or none
        mutable std::once_flag once; // several threads may request it
        mutable std::optional<Point> point;
    };
    const Point& point_of(const Made& made) const {
        std::call_once(made.once, [&] {
            if (!made.point)
                made.point = made.planes[0] == none ? point_of(made.crossing) : point_of(made.planes);
        });
        return *made.point;
    }

    Index add(std::vector<Index>& here, Made made, const Vec3& place) {
        const auto node = static_cast<Index>(size());
        made_.push_back(std::move(made));
        rounded_.push_back(place);
        here.push_back(node);
        return node;
    }

    /// The intersection of a line along an axis and a plane perpendicular to it. No number needs to be
    /// computed.
    std::optional<Point> plain_point_of(const SideCrossing& crossing) const {
        if (std::max(crossing.low, crossing.high) >= points_.size()) return {};
        const Vec3 &p = points_[crossing.low], &q = points_[crossing.high];
        const auto& [a, b, c] = soup_.triangles[crossing.triangle];
        std::array<double, 3> place{};
        for (std::size_t k = 0; k < 3; ++k) {
            const bool level = is_level(points_[a], points_[b], points_[c], k);
            if (p[k] != q[k] && !level) return {};
            place[k] = level ? points_[a][k] : p[k];
        }
        return Point(place[0], place[1], place[2]);
    }

    static double nearest(const ExactKernel::FT& x) { return CGAL::to_double(CGAL::exact(x)); }

    const TriangleSoup& soup_;
    const std::vector<Vec3>& points_;
    std::deque<Made> made_;
    std::vector<Vec3> rounded_; ///< rounded positions of made_
    std::unordered_map<std::uint64_t, std::vector<Index>> at_place_;
    std::unordered_map<PlaneTriple, Index, HashOfIndices> of_planes_;
};

/// A segment between nodes, in a triangle, and one of the crossing triangles that cause it.
struct Segment {
    Index from, to, across;
    auto operator<=>(const Segment&) const = default;
};

/// The input of a cut: triangles in one plane, with area, that overlap or coincide.
struct PlaneGroup {
    std::vector<Index> triangles;
    std::vector<Index> points; ///< nodes in the triangles
    std::vector<Segment> segments;
};

/// Maps (triangle, node) to the side of the triangle that contains the node.
using SidesOfNodes = std::unordered_map<std::pair<Index, Index>, int, HashOfIndices>;

/// Appends the pieces, group by group. Uses constrained triangulations with exact intersections, whose
/// points become nodes. A single triangle is cut with floating point only, if that is certainly correct
/// (geometry/polygon/certain_triangulation.hpp). Parallel and deterministic.
void cut_in_planes(const TriangleSoup& soup, const std::vector<PlaneGroup>& groups, ExactNodes& nodes,
                   std::vector<Arrangement::Piece>& pieces, SidesOfNodes& sides);

} // namespace facetmill

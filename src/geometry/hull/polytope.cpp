#include "geometry/hull/enclosing.hpp"
#include "geometry/spatial/closest_point.hpp"

#include <algorithm>
#include <map>

namespace facetmill {

namespace {

struct CornerLimits {
    std::size_t most = 0;
    double closest = 0; ///< the smallest distance between two corners
};

/// A convex polytope as loops of corners, which planes cut.
class Polytope {
  public:
    explicit Polytope(const FittedBox& box) : points_(box_corners(box)) {
        // Corner i is at the positive end of axis k if bit k of i is set. The frame is right-handed.
        faces_ = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    }

    std::vector<Index> corners() const {
        std::vector<Index> used;
        for (const auto& face : faces_) used.insert(used.end(), face.begin(), face.end());
        std::sort(used.begin(), used.end());
        used.erase(std::unique(used.begin(), used.end()), used.end());
        return used;
    }
    const Vec3& point(Index i) const { return points_[i]; }

    /// Removes the side that the normal points to, or less of it. Does nothing, and returns false, if the
    /// rest would have more than max_corners or close corners, or if rounding leaves the cut without a single
    /// outline.
    bool cut(const Vec3& normal, double offset, const CornerLimits& limits) {
        const std::vector<double> beyond = heights(normal, offset, limits.closest);
        Polytope rest = *this;
        rest.faces_.clear();
        std::map<std::pair<Index, Index>, Index> crossings;
        const auto crossing = [&](Index a, Index b) {
            const auto [low, high] = std::minmax(a, b);
            if (beyond[low] == 0) return low;
            if (beyond[high] == 0) return high;
            const auto [at, fresh] =
                crossings.try_emplace({low, high}, static_cast<Index>(rest.points_.size()));
            if (fresh) {
                const double t = beyond[low] / (beyond[low] - beyond[high]);
                rest.points_.push_back(mix(points_[low], points_[high], t));
            }
            return at->second;
        };
        std::map<Index, Index> rim; // the outline of the cut, against the direction of the faces
        for (const auto& face : faces_) {
            std::vector<Index> loop;
            Index leaves = none, enters = none;
            for (std::size_t i = 0; i < face.size(); ++i) {
                const Index a = face[i], b = face[(i + 1) % face.size()];
                if (!(beyond[a] > 0)) loop.push_back(a);
                if ((beyond[a] > 0) == (beyond[b] > 0)) continue;
                const Index x = crossing(a, b);
                (beyond[b] > 0 ? leaves : enters) = x;
                if (x != a && x != b) loop.push_back(x);
            }
            if (leaves != none && enters != none && leaves != enters) rim[enters] = leaves;
            if (loop.size() > 2) rest.faces_.push_back(std::move(loop));
        }
        if (!rest.close(rim) || !rest.keeps(limits, points_.size())) return false;
        *this = std::move(rest);
        return true;
    }

  private:
    /// The heights of all corners above the plane, which moves outward until no corner is just below it. A
    /// corner just above it counts as on it, with height 0.
    std::vector<double> heights(const Vec3& normal, double offset, double closest) const {
        std::vector<double> all(points_.size()), sorted;
        for (std::size_t i = 0; i < points_.size(); ++i) all[i] = dot(normal, points_[i]) - offset;
        sorted.reserve(points_.size());
        for (const Index c : corners()) sorted.push_back(all[c]);
        std::sort(sorted.begin(), sorted.end());
        double outward = 0;
        for (const double height : sorted)
            if (height < outward && height > outward - closest) outward = height + closest;
        for (double& height : all) {
            height -= outward;
            if (height > 0 && height < closest) height = 0;
        }
        return all;
    }
    /// Whether there are few enough corners, and those from the first new one keep their distance.
    bool keeps(const CornerLimits& limits, std::size_t first_new) const {
        const std::vector<Index> all = corners();
        if (all.size() > limits.most) return false;
        for (const Index c : all) {
            if (c < first_new) continue;
            for (const Index other : all)
                if (other < c && length(points_[c] - points_[other]) < limits.closest) return false;
        }
        return true;
    }
    /// Adds the face along the rim, if it is a single loop.
    bool close(const std::map<Index, Index>& rim) {
        if (rim.size() < 3) return false;
        std::vector<Index> loop;
        Index at = rim.begin()->first;
        do {
            loop.push_back(at);
            const auto next = rim.find(at);
            if (next == rim.end() || loop.size() > rim.size()) return false;
            at = next->second;
        } while (at != loop.front());
        if (loop.size() != rim.size()) return false;
        faces_.push_back(std::move(loop));
        return true;
    }

    std::vector<Vec3> points_;
    std::vector<std::vector<Index>> faces_;
};

Surface surface_of(const ConvexSurface& hull) {
    Surface surface;
    surface.positions = hull.points;
    surface.corners.reserve(3 * hull.triangles.size());
    for (const auto& t : hull.triangles) surface.corners.insert(surface.corners.end(), t.begin(), t.end());
    return surface;
}

struct Far {
    Index corner = none;
    Vec3 towards; ///< the unit vector from the nearest point of the hull
    double distance = 0;
};

} // namespace

std::vector<Vec3> polytope_around(const ConvexSurface& hull, std::size_t max_vertices) {
    const FittedBox box = oriented_box(hull);
    const Surface surface = surface_of(hull);
    const FaceTree tree(surface, FaceTree::Use::few);
    // Corners stay apart in the precision of files, even if the part is a few diagonals from the origin.
    const double closest = 0x1p-18 * length(box.size);
    Polytope polytope(box);
    std::map<Index, Far> known; // by corner; a corner that cannot be cut has no distance
    for (bool changed = true; changed;) {
        changed = false;
        Far farthest;
        for (const Index c : polytope.corners()) {
            auto [at, fresh] = known.try_emplace(c);
            if (fresh) {
                const Closest near = closest_point(tree, polytope.point(c));
                at->second = {c, normalised(polytope.point(c) - near.point), near.distance};
            }
            if (at->second.distance > farthest.distance) farthest = at->second;
        }
        if (farthest.distance <= closest) break;
        double offset = -HUGE_VAL;
        for (const Vec3& p : hull.points) offset = std::max(offset, dot(farthest.towards, p));
        known[farthest.corner].distance = 0;
        changed = true;
        (void)polytope.cut(farthest.towards, offset, {max_vertices, closest});
    }
    std::vector<Vec3> corners;
    for (const Index c : polytope.corners()) corners.push_back(polytope.point(c));
    return corners;
}

} // namespace facetmill

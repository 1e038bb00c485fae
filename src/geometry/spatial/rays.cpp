#include "geometry/spatial/rays.hpp"

#include "base/math/predicates.hpp"
#include "geometry/polygon/polygon.hpp"
#include "geometry/spatial/rays_walk.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

std::vector<Hit> searched(const FaceTree& tree, const Line& line, bool all) {
    if (!rays::is_line(line)) return {};
    rays::LineSearch search(tree, line, all);
    while (search.step()) {
    }
    return search.hits();
}

} // namespace

int passes(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) {
    return from == to ? 0 : rays::LineSigns(from, to).passes(a, b, c);
}

std::optional<Hit> first_hit(const FaceTree& tree, const Line& line) {
    const auto hits = searched(tree, line, false);
    return hits.empty() ? std::nullopt : std::optional(hits[0]);
}

std::vector<Hit> all_hits(const FaceTree& tree, const Line& line) { return searched(tree, line, true); }

int winding_beside(const FaceTree& tree, const Vec3& from, int winding_there, const Vec3& to) {
    const Line line{from, to};
    if (!rays::is_line(line)) return winding_there;
    const rays::LineTest test(line);
    rays::LineWalk walk(tree, line);
    int left = 0;
    while (walk.step([&](Index triangle) {
        if (const auto hit = test.hit(tree, triangle)) left += hit->way;
        return HUGE_VAL;
    })) {
    }
    return winding_there - left;
}

// Implements the cases of a segment and a facet of geometry/spatial/rays.hpp.

const char* to_string(Meeting meeting) {
    constexpr const char* names[] = {"hit", "parallel", "in plane", "outside segment", "outside facet"};
    return names[static_cast<std::size_t>(meeting)];
}

SegmentFacet meet(const Line& line, std::span<const Vec3> facet) {
    SegmentFacet result;
    std::size_t second = 1, third = 2;
    while (third < facet.size() && collinear(facet[0], facet[second], facet[third])) {
        if (facet[0] == facet[second]) second = third;
        ++third;
    }
    if (third >= facet.size()) return result; // no plane
    const Vec3 &a = facet[0], &b = facet[second], &c = facet[third];
    const Vec3 n = cross(b - a, c - a), d = line.to - line.from;
    const int from = orientation_3d(a, b, c, line.from), to = orientation_3d(a, b, c, line.to);
    const double along = dot(n, d);
    if (from == 0 && to == 0) {
        result.meeting = Meeting::in_plane;
        return result;
    }
    if (along == 0 || line.from == line.to) return result;
    result.t = from == 0 ? 0 : to == 0 ? 1 : dot(n, a - line.from) / along;
    result.point = line.from + d * result.t;
    const bool crosses = line.ray ? from == 0 || (along > 0) == (from < 0) : from * to <= 0;
    if (!crosses) {
        result.meeting = Meeting::outside_segment;
        return result;
    }
    // Projects along the axis nearest to the normal, with the point where the line meets the plane.
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(n[i]) > std::abs(n[axis])) axis = i;
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<Vec2> ring;
    for (const Vec3& p : facet) ring.push_back({p[u], p[v]});
    const auto place = polygon::locate({result.point[u], result.point[v]}, ring);
    result.meeting = place == polygon::PointLocation::outside ? Meeting::outside_facet : Meeting::hit;
    return result;
}

// Implements the inside test of geometry/spatial/rays.hpp. A ray along an axis needs two comparisons per
// box, and signs in the plane.

namespace {

/// The boxes of a node that may meet the ray: float32 comparisons with numbers rounded outward.
class AxisQuery {
  public:
    AxisQuery(const FaceTree& tree, const Vec3& p, std::size_t axis, bool forward)
        : axis_(axis), forward_(forward) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = std::clamp(tree.local(p[i], i), -4.0, 4.0); // the surface is within 1
            low_[i] = rounded_down(x);
            high_[i] = rounded_up(x);
        }
    }

    bool may_meet(const FaceTree::Node& node, std::size_t slot) const {
        bool meets = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const bool after = node.min[i][slot] <= high_[i], before = node.max[i][slot] >= low_[i];
            meets &= i != axis_ ? after & before : forward_ ? before : after;
        }
        return meets;
    }

  private:
    std::size_t axis_;
    bool forward_;
    std::array<float, 3> low_{}, high_{};
};

template <class Query, class Found>
void visit(const FaceTree& tree, const Query& query, Found&& found) {
    if (tree.empty()) return;
    struct Entry {
        std::int32_t level;
        std::uint32_t node;
    };
    Entry stack[4 * 17];
    int size = 0;
    stack[size++] = {tree.height() - 1, 0};
    while (size > 0) {
        const Entry entry = stack[--size];
        const auto& node = tree.node(entry.level, entry.node);
        for (std::uint32_t s = 0; s < 4; ++s) {
            if (!query.may_meet(node, s)) continue;
            if (entry.level > 0)
                stack[size++] = {entry.level - 1, 4 * entry.node + s};
            else
                found(4 * entry.node + s);
        }
    }
}

/// The side of the edge that contains the point, projected along the axis. A point on the edge's line is
/// treated as if moved a little along u, and by less along v. Returns 0 only for an edge seen as a point.
int side(const Vec3& a, const Vec3& b, const Vec3& p, std::size_t u, std::size_t v) {
    if (const int sign = orientation_2d(a[u], a[v], b[u], b[v], p[u], p[v])) return sign;
    if (a[v] != b[v]) return b[v] > a[v] ? -1 : 1;
    return a[u] == b[u] ? 0 : b[u] > a[u] ? 1 : -1;
}

int crossing(const FaceTree::Triangle& t, const Vec3& p, std::size_t axis, bool forward) {
    return passes_along_axis(p, axis, forward, t.a, t.b, t.c);
}

bool holds(const FaceTree::Triangle& t, const Vec3& p) {
    if (collinear(t.a, t.b, t.c)) { // a segment
        const auto within = [&](const Vec3& a, const Vec3& b) {
            if (!collinear(a, b, p)) return false;
            for (std::size_t i = 0; i < 3; ++i)
                if (p[i] < std::min(a[i], b[i]) || p[i] > std::max(a[i], b[i])) return false;
            return true;
        };
        return within(t.a, t.b) || within(t.b, t.c) || within(t.c, t.a);
    }
    if (orientation_3d(t.a, t.b, t.c, p) != 0) return false;
    // The projection along at least one axis has an area.
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
        const int way = orientation_2d(t.a[u], t.a[v], t.b[u], t.b[v], t.c[u], t.c[v]);
        if (way == 0) continue;
        const auto inside = [&](const Vec3& a, const Vec3& b) {
            return orientation_2d(a[u], a[v], b[u], b[v], p[u], p[v]) * way >= 0;
        };
        return inside(t.a, t.b) && inside(t.b, t.c) && inside(t.c, t.a);
    }
    return false;
}

class PointQuery {
  public:
    PointQuery(const FaceTree& tree, const Vec3& p) {
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = std::clamp(tree.local(p[i], i), -4.0, 4.0);
            low_[i] = rounded_down(x);
            high_[i] = rounded_up(x);
        }
    }
    bool may_meet(const FaceTree::Node& node, std::size_t slot) const {
        bool meets = true;
        for (std::size_t i = 0; i < 3; ++i)
            meets &= node.min[i][slot] <= high_[i] && node.max[i][slot] >= low_[i];
        return meets;
    }

  private:
    std::array<float, 3> low_{}, high_{};
};

} // namespace

int passes_along_axis(const Vec3& p, std::size_t axis, bool forward, const Vec3& a, const Vec3& b,
                      const Vec3& c) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int way = side(a, b, p, u, v); // 1: the front faces along the axis
    if (way == 0 || side(b, c, p, u, v) != way || side(c, a, p, u, v) != way) return 0;
    const int over = orientation_3d(a, b, c, p) * way; // 1: p is beyond the triangle along the axis
    if (forward ? over >= 0 : over <= 0) return 0;
    return forward ? way : -way;
}

int winding(const FaceTree& tree, const Vec3& p) {
    if (tree.empty() || !is_finite(p)) return 0;
    // The ray runs towards the nearest side of the bounds, because the fewest faces are in its way.
    const Vec3 at = tree.local(p);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(at[i]) > std::abs(at[axis])) axis = i;
    const bool forward = at[axis] >= 0;
    int sum = 0;
    visit(tree, AxisQuery(tree, p, axis, forward),
          [&](Index t) { sum += crossing(tree.triangle(t), p, axis, forward); });
    return sum;
}

void visit_along_axis(const FaceTree& tree, const Vec3& p, std::size_t axis, bool forward,
                      const std::function<void(Index face, int way)>& hit) {
    if (tree.empty() || !is_finite(p)) return;
    visit(tree, AxisQuery(tree, p, axis, forward), [&](Index t) {
        if (const int way = crossing(tree.triangle(t), p, axis, forward)) hit(tree.face(t), way);
    });
}

bool lies_on(const FaceTree& tree, const Vec3& p) {
    if (tree.empty() || !is_finite(p)) return false;
    bool on = false;
    visit(tree, PointQuery(tree, p), [&](Index t) { on = on || holds(tree.triangle(t), p); });
    return on;
}

} // namespace facetmill

// Inside or outside, of geometry/spatial/rays.hpp: a ray along an axis needs two comparisons a box and signs in the
// plane.
#include "base/predicates.hpp"
#include "geometry/spatial/rays.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

/// The boxes of a node that may hold something on the ray: float32 comparisons with numbers rounded outward.
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

/// On which side of the edge the point is, seen along the axis; a point on its line as if moved a little
/// along u, and by less along v. 0 only for an edge seen as a point.
int side(const Vec3& a, const Vec3& b, const Vec3& p, std::size_t u, std::size_t v) {
    if (const int sign = orientation_2d(a[u], a[v], b[u], b[v], p[u], p[v])) return sign;
    if (a[v] != b[v]) return b[v] > a[v] ? -1 : 1;
    return a[u] == b[u] ? 0 : b[u] > a[u] ? 1 : -1;
}

int crossing(const FaceTree::Triangle& t, const Vec3& p, std::size_t axis, bool forward) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const int way = side(t.a, t.b, p, u, v); // 1: the front faces along the axis
    if (way == 0 || side(t.b, t.c, p, u, v) != way || side(t.c, t.a, p, u, v) != way) return 0;
    const int over = orientation_3d(t.a, t.b, t.c, p) * way; // 1: p is beyond the triangle along the axis
    if (forward ? over >= 0 : over <= 0) return 0;
    return forward ? way : -way;
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
    // Some axis sees the triangle with an area.
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

int winding(const FaceTree& tree, const Vec3& p) {
    if (tree.empty() || !is_finite(p)) return 0;
    // Towards the nearest side of the whole, where least is in the way.
    const Vec3 at = tree.local(p);
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(at[i]) > std::abs(at[axis])) axis = i;
    const bool forward = at[axis] >= 0;
    int sum = 0;
    visit(tree, AxisQuery(tree, p, axis, forward),
          [&](Index t) { sum += crossing(tree.triangles[t], p, axis, forward); });
    return sum;
}

void visit_along_axis(const FaceTree& tree, const Vec3& p, std::size_t axis, bool forward,
                      const std::function<void(Index face, int way)>& hit) {
    if (tree.empty() || !is_finite(p)) return;
    visit(tree, AxisQuery(tree, p, axis, forward), [&](Index t) {
        if (const int way = crossing(tree.triangles[t], p, axis, forward)) hit(tree.faces[t], way);
    });
}

bool lies_on(const FaceTree& tree, const Vec3& p) {
    if (tree.empty() || !is_finite(p)) return false;
    bool on = false;
    visit(tree, PointQuery(tree, p), [&](Index t) { on = on || holds(tree.triangles[t], p); });
    return on;
}

} // namespace facetmill

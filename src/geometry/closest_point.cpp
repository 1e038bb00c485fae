// After C. Ericson, "Real-Time Collision Detection" (2005), 5.1.5, with edges and corners by segments, so
// that slivers lose nothing.
#include "geometry/closest_point.hpp"

#include "base/parallel.hpp"
#include "geometry/space_curve.hpp"

#include <algorithm>
#include <limits>

namespace facetmill {

namespace {

/// The point of the segment from a to b closest to the origin.
Vec3 closest_on_segment(const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double square = dot(along, along), t = -dot(a, along);
    if (!(t > 0) || !(square > 0)) return a;
    if (t >= square) return b;
    return a + along * (t / square);
}

/// The point of the triangle closest to the origin. The corners are relative to the query.
Vec3 closest_to_origin(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, n = cross(ab, ac);
    // Twice the areas seen along the normal, times its length: negative beyond an edge.
    const double wa = dot(n, cross(b, c)), wb = dot(n, cross(c, a)), wc = dot(n, cross(a, b));
    const double sum = wa + wb + wc, size = dot(ab, ab) + dot(ac, ac);
    const bool sliver = !(dot(n, n) > 1e-8 * size * size);
    Vec3 best = a;
    double least = HUGE_VAL;
    const auto consider = [&](const Vec3& q) {
        if (const double square = dot(q, q); square < least) least = square, best = q;
    };
    if (wa >= 0 && wb >= 0 && wc >= 0 && sum > 0) {
        consider(a * (wa / sum) + b * (wb / sum) + c * (wc / sum));
        if (!sliver) return best;
    }
    // Beyond an edge the closest point is on an edge that the query is beyond. The signs of a sliver are
    // worth little: all its edges are tried.
    if (sliver || wc < 0) consider(closest_on_segment(a, b));
    if (sliver || wa < 0) consider(closest_on_segment(b, c));
    if (sliver || wb < 0) consider(closest_on_segment(c, a));
    return best;
}

/// From p to the closest point of a triangle, times the tree's scale.
Vec3 offset_to(const FaceTree& tree, Index triangle, const Vec3& p) {
    const auto& t = tree.triangles[triangle];
    return closest_to_origin((t.a - p) * tree.scale, (t.b - p) * tree.scale, (t.c - p) * tree.scale);
}

using Float4 = float __attribute__((vector_size(16)));

Float4 load(const float (&four)[4]) { return Float4{four[0], four[1], four[2], four[3]}; }
Float4 greater(const Float4& a, const Float4& b) { return a > b ? a : b; }

/// A query in the tree's frame. Far queries are drawn near, which only makes the bounds below smaller.
struct Query {
    Float4 low[3], high[3];

    Query(const FaceTree& tree, const Vec3& p) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = std::clamp(tree.local(p[axis], axis), -1e15, 1e15);
            low[axis] = Float4{} + rounded_down(x);
            high[axis] = Float4{} + rounded_up(x);
        }
    }

    /// Lower bounds of the squared distances to the four boxes.
    Float4 bounds(const FaceTree::Node& node) const {
        Float4 sum{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Float4 d = greater(
                greater(load(node.min[axis]) - high[axis], low[axis] - load(node.max[axis])), Float4{});
            sum += d * d;
        }
        return sum * (1 - 1e-6F);
    }
};

/// Works in units of the tree's frame: squares then neither overflow nor vanish, whatever the surface's size.
class Search {
  public:
    Search(const FaceTree& tree, const Vec3& p) : tree_(tree), p_(p) {}

    void test(Index triangle) {
        const Vec3 q = offset_to(tree_, triangle, p_);
        const double square = dot(q, q);
        if (square > square_ || (square == square_ && tree_.faces[triangle] >= face_)) return;
        square_ = square, offset_ = q, triangle_ = triangle, face_ = tree_.faces[triangle];
        const double limit = square * (1 + 1e-6);
        limit_ = limit < 1e38 ? static_cast<float>(limit) + std::numeric_limits<float>::min() : 1e38F;
    }

    void run(double enough) {
        const double enough_square = enough < 0 ? -1 : enough * tree_.scale * enough * tree_.scale;
        const Query query(tree_, p_);
        struct Entry {
            float bound;
            std::int32_t level;
            std::uint32_t node;
        };
        Entry stack[4 * 17]; // 17 levels of four hold all indices; three wait at each
        int size = 0;
        stack[size++] = {0, tree_.height() - 1, 0};
        while (size > 0) {
            const Entry entry = stack[--size];
            if (entry.bound > limit_) continue;
            const Float4 bounds = query.bounds(tree_.node(entry.level, entry.node));
            // Those near enough, nearest last.
            Entry near[4];
            int count = 0;
            for (int s = 0; s < 4; ++s) {
                if (bounds[s] > limit_) continue;
                int at = count++;
                for (; at > 0 && near[at - 1].bound < bounds[s]; --at) near[at] = near[at - 1];
                near[at] = {bounds[s], entry.level - 1, 4 * entry.node + static_cast<std::uint32_t>(s)};
            }
            if (entry.level > 0) {
                for (int i = 0; i < count; ++i) stack[size++] = near[i];
                continue;
            }
            for (int i = count - 1; i >= 0; --i)
                if (near[i].bound <= limit_) test(near[i].node);
            if (square_ <= enough_square) return;
        }
    }

    Closest result() const {
        if (triangle_ == none) return {};
        return {p_ + offset_ / tree_.scale, std::sqrt(square_) / tree_.scale, face_, triangle_};
    }

  private:
    const FaceTree& tree_;
    const Vec3& p_;
    Vec3 offset_; ///< from p to the closest point so far, in the tree's frame
    double square_ = HUGE_VAL;
    float limit_ = 1e38F; ///< of squared distances in the tree's frame
    Index triangle_ = none, face_ = none;
};

} // namespace

Closest closest_on(const FaceTree& tree, Index triangle, const Vec3& p) {
    const Vec3 q = offset_to(tree, triangle, p);
    return {p + q / tree.scale, length(q) / tree.scale, tree.faces[triangle], triangle};
}

Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    return p + closest_to_origin(a - p, b - p, c - p);
}

Closest closest_point(const FaceTree& tree, const Vec3& p, Index hint, double enough) {
    if (tree.empty() || !is_finite(p)) return {};
    Search search(tree, p);
    if (hint != none) search.test(hint);
    search.run(enough);
    return search.result();
}

std::vector<Closest> closest_points(const FaceTree& tree, std::span<const Vec3> points) {
    const std::vector<Index> order =
        order_along_curve(points.size(), box_of(points), [&](std::size_t i) { return points[i]; });
    std::vector<Closest> found(points.size());
    parallel_chunks(
        points.size(),
        [&](std::size_t begin, std::size_t end) {
            Index hint = none;
            for (std::size_t i = begin; i < end; ++i) {
                found[order[i]] = closest_point(tree, points[order[i]], hint);
                hint = found[order[i]].triangle;
            }
        },
        1024);
    return found;
}

} // namespace facetmill

#pragma once
// The intersection search of geometry/spatial/rays.hpp: the exact test of a triangle, and a walk through the
// tree in steps, so that many lines can be interleaved.

#include "base/math/predicates.hpp"
#include "base/math/simd.hpp"
#include "geometry/spatial/rays.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace facetmill::rays {

/// A point off the line through from and to: one step along the axis with the smallest component of its
/// direction.
[[nodiscard]] inline Vec3 point_beside(const Vec3& from, const Vec3& to) {
    const Vec3 d = to - from;
    std::size_t axis = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (std::abs(d[i]) < std::abs(d[axis])) axis = i;
    Vec3 beside = from;
    beside[axis] = from[axis] == 0 ? 1 : from[axis] * 2;
    return beside;
}

/// The surface is viewed along the line, which appears as a point. The half plane through `beside` is a ray
/// from this point to the right. A triangle contains the point if the ray crosses its border an odd number
/// of times. A corner on the ray's line counts as above it, and an edge through the point as to the right.
/// This choice depends only on the corner or the edge, never on the face, so neighbours always agree.
class LineSigns {
  public:
    LineSigns(const Vec3& from, const Vec3& to) : from_(from), to_(to), beside_(point_beside(from, to)) {}

    int passes(const Vec3& a, const Vec3& b, const Vec3& c) const {
        const bool above[] = {is_above(a), is_above(b), is_above(c)};
        if (above[0] == above[1] && above[1] == above[2]) return 0;
        const int ways = crossing(a, b, above[0], above[1]) + crossing(b, c, above[1], above[2]) +
                         crossing(c, a, above[2], above[0]);
        return ways; // a triangle goes around the point once in either direction, or not at all
    }

  private:
    bool is_above(const Vec3& p) const { return orientation_3d(from_, to_, beside_, p) >= 0; }

    /// Returns 1 if the edge crosses the ray upward, -1 downward, 0 if it does not cross or crosses to the
    /// left of the point. Seen along the line with `beside` to the right, "above" is to the front of (from,
    /// to, beside), and the line runs towards the viewer's back. So a front face that the line leaves
    /// through is anticlockwise.
    int crossing(const Vec3& a, const Vec3& b, bool a_above, bool b_above) const {
        if (a_above == b_above) return 0;
        // Uses the edge upward, so that both of its faces compute the same.
        const Vec3 &low = a_above ? b : a, &high = a_above ? a : b;
        const int side = orientation_3d(from_, to_, low, high);
        if (side < 0) return 0; // the point is to the right of the edge
        return a_above ? -1 : 1;
    }

    const Vec3 &from_, &to_;
    const Vec3 beside_;
};

/// Tests a line against triangles.
class LineTest {
  public:
    explicit LineTest(const Line& line) : line_(line), signs_(line.from, line.to) {}

    std::optional<Hit> hit(const FaceTree& tree, Index triangle) const {
        const auto [a, b, c] = tree.triangle(triangle);
        const int way = signs_.passes(a, b, c);
        if (way == 0) return {};
        const int from_side = orientation_3d(a, b, c, line_.from);
        if (from_side * way > 0) return {}; // the line has left the plane before it begins
        if (!line_.ray && orientation_3d(a, b, c, line_.to) * way < 0) return {};
        Hit hit;
        hit.way = way;
        hit.triangle = triangle;
        hit.face = tree.face(triangle);
        const Vec3 n = cross(b - a, c - a), d = line_.to - line_.from;
        const double along = dot(n, d), t = along != 0 ? dot(n, a - line_.from) / along : 0;
        hit.t = from_side == 0 ? 0 : std::max(t, 0.0);
        if (!line_.ray) hit.t = std::min(hit.t, 1.0);
        hit.point = line_.from + d * hit.t;
        return hit;
    }

  private:
    const Line& line_;
    LineSigns signs_;
};

inline bool before(const Hit& a, const Hit& b) {
    return a.t != b.t ? a.t < b.t : a.face != b.face ? a.face < b.face : a.triangle < b.triangle;
}

/// The line in the tree's frame, in float32. Boxes are enlarged by more than the rounding error.
class LineQuery {
  public:
    LineQuery(const FaceTree& tree, const Line& line) {
        const Vec3 from = tree.local(line.from), d = (line.to - line.from) * tree.scale;
        // The part of the line near the surface, so that float32 suffices. Its numbers are in [-1, 1], plus
        // a margin.
        double begin = 0, end = line.ray ? HUGE_VAL : 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (d[axis] == 0) {
                if (std::abs(from[axis]) > 1.5) end = -1;
                continue;
            }
            const double t0 = (-1.5 - from[axis]) / d[axis], t1 = (1.5 - from[axis]) / d[axis];
            begin = std::max(begin, std::min(t0, t1));
            end = std::min(end, std::max(t0, t1));
        }
        misses_ = !(begin <= end);
        if (misses_) return;
        begin_ = begin;
        const Vec3 start = from + d * begin;
        const double reach = std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)});
        const Float4 margin = Float4{} + static_cast<float>(0x1p-18 + reach * 0x1p-48);
        // Uses units of the longest component, so that t is a length in the frame, at most 3.
        longest_ = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        length_ = static_cast<float>((end - begin) * longest_ * (1 + 1e-6)) + 1e-6F;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            double step = d[axis] / longest_;
            if (std::abs(step) < 1e-12)
                step = step < 0 ? -1e-12 : 1e-12; // changes by less than the margin over the whole line
            inverse_[axis] = Float4{} + static_cast<float>(1 / step);
            const Float4 at = Float4{} + static_cast<float>(start[axis]);
            low_[axis] = at + margin;
            high_[axis] = at - margin;
            forward_[axis] = step > 0;
        }
    }

    bool misses() const { return misses_; }
    float length() const { return length_; }
    /// The parameter t of the line as a length in the frame, rounded up.
    float length_to(double t) const {
        return static_cast<float>((t - begin_) * longest_ * (1 + 1e-6)) + 1e-5F;
    }

    /// Lower bounds of the lengths at which the line enters four boxes; infinity if it misses a box before
    /// `end`.
    Float4 entries(const FaceTree::Node& node, float end) const {
        Float4 near{}, far = Float4{} + end;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Float4 low = (load(node.min[axis]) - low_[axis]) * inverse_[axis];
            const Float4 high = (load(node.max[axis]) - high_[axis]) * inverse_[axis];
            near = greater(near, forward_[axis] ? low : high);
            far = lesser(far, forward_[axis] ? high : low);
        }
        return near <= far ? near : Float4{} + HUGE_VALF;
    }

  private:
    Float4 low_[3] = {}, high_[3] = {}, inverse_[3] = {};
    bool forward_[3] = {};
    double begin_ = 0, longest_ = 1;
    float length_ = 0;
    bool misses_ = false;
};

/// The triangles whose boxes a line meets, roughly from near to far, one node at a time.
class LineWalk {
  public:
    /// t_max: the t up to which the search goes at first.
    LineWalk(const FaceTree& tree, const Line& line, double t_max = HUGE_VAL)
        : tree_(tree), query_(tree, line) {
        if (tree.empty() || query_.misses()) return;
        end_ = t_max < HUGE_VAL ? std::min(query_.length(), query_.length_to(t_max)) : query_.length();
        stack_[size_++] = {0, tree.height() - 1, 0};
    }

    /// Visits a node, or calls found(triangle), which returns the t up to which the search continues. False
    /// at the end.
    template <class Found>
    bool step(Found&& found) {
        do
            if (size_ == 0) return false;
        while (stack_[--size_].near > end_);
        const Entry entry = stack_[size_];
        if (entry.level < 0) {
            end_ = std::min(end_, query_.length_to(found(Index{entry.node})));
            return true;
        }
        const Float4 entries = query_.entries(tree_.node(entry.level, entry.node), end_);
        const int before = size_;
        for (unsigned bits = bits_of(entries < HUGE_VALF); bits != 0; bits &= bits - 1) {
            const auto s = static_cast<std::uint32_t>(std::countr_zero(bits));
            int at = size_++;
            for (; at > before && stack_[at - 1].near < entries[s]; --at) stack_[at] = stack_[at - 1];
            stack_[at] = {entries[s], entry.level - 1, 4 * entry.node + s};
            fetch(entry.level - 1, 4 * entry.node + s);
        }
        return true;
    }

  private:
    struct Entry {
        float near;
        std::int32_t level; ///< -1: a triangle
        std::uint32_t node;
    };

    [[gnu::always_inline]] void fetch(int level, std::uint32_t node) const {
        level < 0 ? tree_.fetch_triangle(node) : fetch_soon(tree_.node(level, node));
    }

    const FaceTree& tree_;
    LineQuery query_;
    float end_ = 0;
    int size_ = 0;
    Entry stack_[4 * 18]; // 17 levels of four hold all indices, and the triangles; three wait at each
};

/// Searches the first hit or all hits of a line, step by step.
class LineSearch {
  public:
    LineSearch(const FaceTree& tree, const Line& line, bool all)
        : tree_(tree), test_(line), walk_(tree, line), all_(all) {}

    /// False at the end.
    bool step() {
        return walk_.step([&](Index triangle) {
            const auto hit = test_.hit(tree_, triangle);
            if (hit && (all_ || hits_.empty()))
                hits_.push_back(*hit);
            else if (hit && before(*hit, hits_[0]))
                hits_[0] = *hit;
            return all_ || hits_.empty() ? HUGE_VAL : hits_[0].t;
        });
    }

    /// The hits in order, at the end of the search.
    const std::vector<Hit>& hits() {
        std::sort(hits_.begin(), hits_.end(), before);
        return hits_;
    }

  private:
    const FaceTree& tree_;
    LineTest test_;
    LineWalk walk_;
    bool all_;
    std::vector<Hit> hits_;
};

/// False for a line without length, which meets only the faces that contain its point, and for a line that
/// is not finite.
inline bool is_line(const Line& line) {
    return is_finite(line.from) && is_finite(line.to) && !(line.from == line.to);
}

} // namespace facetmill::rays

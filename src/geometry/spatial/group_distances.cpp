#include "geometry/spatial/group_distances.hpp"

#include "geometry/spatial/closest_point.hpp"

#include <algorithm>
#include <bit>

namespace facetmill {

namespace {

constexpr std::size_t few_nodes = 24; ///< limit for nodes of a level; with more, smaller groups are as fast
constexpr std::size_t many_nodes =
    64; ///< limit for nodes of a level; with more, smaller groups of parts are as fast
constexpr double farthest_reach =
    32; ///< in the tree's frame; its float32 numbers are too coarse for points beyond
constexpr float rounding = TriangleSlabs::rounding; ///< points this close to an edge count as outside

Float4 four(float x) { return Float4{x, x, x, x}; }

Box box_around(std::span<const Vec3> points) {
    Box box;
    for (const Vec3& p : points) box.add(p);
    return box;
}

} // namespace

/// A triangle in the group's frame: its plane and, for each edge, the unit directions out of the triangle
/// and along the edge. Numbers near the group are then small and keep their precision.
struct GroupDistances::Flat {
    struct Edge {
        Float4 out[3], reach, along[3], begin, end; ///< each number is stored four times
    };
    Float4 normal[3], offset;
    Edge edges[3];

    /// Returns false for slivers, because their plane is uncertain, and for triangles far beyond the group.
    bool set(const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 ab = b - a, ac = c - a, n = cross(ab, ac);
        const double square = dot(n, n), size = dot(ab, ab) + dot(ac, ac);
        if (!(square > 1e-12 * size * size) || !(size + dot(a, a) < 1e20) || !(square > 1e-60)) return false;
        const Vec3 unit = n * (1 / std::sqrt(square));
        for (std::size_t k = 0; k < 3; ++k) normal[k] = four(static_cast<float>(unit[k]));
        offset = four(static_cast<float>(dot(unit, a)));
        set(edges[0], a, b, ab, unit);
        set(edges[1], b, c, c - b, unit);
        set(edges[2], c, a, a - c, unit);
        return true;
    }

  private:
    static void set(Edge& edge, const Vec3& from, const Vec3& to, const Vec3& way, const Vec3& normal) {
        const Vec3 along = way * (1 / std::sqrt(dot(way, way))), out = cross(along, normal);
        for (std::size_t k = 0; k < 3; ++k) {
            edge.along[k] = four(static_cast<float>(along[k]));
            edge.out[k] = four(static_cast<float>(out[k]));
        }
        edge.reach = four(static_cast<float>(dot(out, from)));
        edge.begin = four(static_cast<float>(dot(along, from)));
        edge.end = four(static_cast<float>(dot(along, to)));
    }
};

/// Stores the points in a frame in which everything within `reach` of the centre is below 1. The last four
/// are padded with the first point. Returns false if the tree's float32 numbers are too coarse.
bool GroupDistances::place(std::span<const Vec3> points, const Vec3& centre, double reach) {
    const Vec3 at = tree_.local(centre);
    if (!(std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) < farthest_reach) ||
        !(reach * tree_.scale > 1e-15 && reach * tree_.scale < farthest_reach))
        return false;
    centre_ = centre;
    scale_ = 1 / reach;
    error_ = 4 * rounding * reach;
    fours_ = (points.size() + 3) / 4;
    for (std::size_t i = 0; i < 4 * fours_; ++i) {
        const Vec3 p = (points[i < points.size() ? i : 0] - centre) * scale_;
        x_[i / 4][i % 4] = static_cast<float>(p.x);
        y_[i / 4][i % 4] = static_cast<float>(p.y);
        z_[i / 4][i % 4] = static_cast<float>(p.z);
    }
    for (std::size_t i = 0; i < fours_; ++i) {
        least_[i] = second_[i] = four(HUGE_VALF);
        nearest_[i] = Int4{};
    }
    return true;
}

/// The squared distances of four points to a triangle; infinity if all are at least `limit`.
Float4 GroupDistances::squares_below(const Float4& limit, const Flat& t, std::size_t four_of) const {
    const Float4 x = x_[four_of], y = y_[four_of], z = z_[four_of];
    const Float4 up = x * t.normal[0] + y * t.normal[1] + z * t.normal[2] - t.offset;
    Float4 beyond[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const Flat::Edge& e = t.edges[k];
        beyond[k] = x * e.out[0] + y * e.out[1] + z * e.out[2] - e.reach;
    }
    const Float4 farthest = greater(greater(beyond[0], beyond[1]), beyond[2]);
    const Float4 aside = greater(farthest, Float4{});
    if (bits_of(up * up + aside * aside < limit) == 0) return four(HUGE_VALF);
    // The distance in the plane: 0 inside, and beyond an edge the distance to the edge.
    Float4 across = farthest <= four(-rounding) ? Float4{} : four(HUGE_VALF);
    for (std::size_t k = 0; k < 3; ++k) {
        const Flat::Edge& e = t.edges[k];
        const Float4 along = x * e.along[0] + y * e.along[1] + z * e.along[2];
        const Float4 past = greater(greater(e.begin - along, along - e.end), Float4{});
        const Float4 out = greater(beyond[k], Float4{});
        across = beyond[k] > four(-rounding) ? lesser(across, out * out + past * past) : across;
    }
    return up * up + across;
}

/// Lowers the points' squared distances to the distances from one triangle.
void GroupDistances::compare(const Flat& t, Index triangle) {
    for (std::size_t i = 0; i < fours_; ++i) {
        const Float4 least = least_[i], second = second_[i];
        if (bits_of(least > four(done_square_)) == 0) continue;
        const Float4 square = squares_below(second, t, i);
        const Int4 nearer = square < least;
        least_[i] = nearer ? square : least;
        second_[i] = nearer ? least : lesser(second, square);
        nearest_[i] = nearer ? Int4{} + static_cast<std::int32_t>(triangle) : nearest_[i];
    }
}

float GroupDistances::square_exactly(const Vec3& p, Index triangle) const {
    const double distance = closest_on(tree_, triangle, p).distance * scale_;
    return static_cast<float>(std::min(distance * distance, 1e30));
}

void GroupDistances::compare_exactly(std::span<const Vec3> points, Index triangle) {
    for (std::size_t i = 0; i < 4 * fours_; ++i) {
        const float square = square_exactly(points[i < points.size() ? i : 0], triangle);
        const float least = least_[i / 4][i % 4];
        second_[i / 4][i % 4] = std::min(second_[i / 4][i % 4], std::max(least, square));
        if (!(square < least)) continue;
        least_[i / 4][i % 4] = square;
        nearest_[i / 4][i % 4] = static_cast<std::int32_t>(triangle);
    }
}

void GroupDistances::compare(std::span<const Vec3> points, Index triangle) {
    Flat flat;
    const auto [a, b, c] = tree_.triangle(triangle);
    if (flat.set((a - centre_) * scale_, (b - centre_) * scale_, (c - centre_) * scale_))
        compare(flat, triangle);
    else
        compare_exactly(points, triangle);
}

float GroupDistances::farthest_square() const {
    Float4 most{};
    for (std::size_t i = 0; i < fours_; ++i) most = greater(most, least_[i]);
    return std::max({most[0], most[1], most[2], most[3]});
}

namespace {

/// A box in the tree's frame, and a test for the boxes within a distance of it.
struct BoxQuery {
    Float4 low[3], high[3], square;

    BoxQuery(const FaceTree& tree, const Box& box, double distance) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = four(rounded_down(tree.local(box.min[axis], axis)));
            high[axis] = four(rounded_up(tree.local(box.max[axis], axis)));
        }
        square = four(square_of(tree, distance));
    }
    /// The squared distance in the tree's frame, rounded up.
    static float square_of(const FaceTree& tree, double distance) {
        const double farthest = distance * tree.scale * (1 + 1e-6);
        return static_cast<float>(farthest * farthest) + 1e-37F;
    }
    /// The squared distances to four boxes.
    Float4 squares(const FaceTree::Node& node) const {
        Float4 sum{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Float4 d = greater(
                greater(load(node.min[axis]) - high[axis], low[axis] - load(node.max[axis])), Float4{});
            sum += d * d;
        }
        return sum;
    }
    /// A bit for each of the four boxes within the distance.
    unsigned near(const Float4& squares) const { return bits_of(squares * (1 - 1e-6F) <= square); }
    unsigned near(const FaceTree::Node& node) const { return near(squares(node)); }
};

} // namespace

/// Finds the nodes of the lowest level within `limit` of the box. Returns false if there are more than
/// `most_nodes`.
bool GroupDistances::gather(const Box& box, double limit, std::size_t most_nodes) {
    const BoxQuery query(tree_, box, limit);
    nodes_.assign(1, 0);
    for (int level = tree_.height() - 1; level > 0; --level) {
        children_.clear();
        for (const std::uint32_t n : nodes_)
            for (unsigned bits = query.near(tree_.node(level, n)); bits != 0; bits &= bits - 1)
                children_.push_back(4 * n + static_cast<std::uint32_t>(std::countr_zero(bits)));
        if (children_.size() > most_nodes) return false;
        nodes_.swap(children_);
    }
    return true;
}

/// Compares all points with the triangles below the gathered nodes within `limit` of the box, until the
/// points are near enough.
bool GroupDistances::compare_until(float enough_square, std::span<const Vec3> points, const Box& box,
                                   double limit) {
    const BoxQuery query(tree_, box, limit);
    for (const std::uint32_t leaf : nodes_)
        for (unsigned bits = query.near(tree_.node(0, leaf)); bits != 0; bits &= bits - 1) {
            compare(points, 4 * leaf + static_cast<Index>(std::countr_zero(bits)));
            if (enough_square >= 0 && farthest_square() <= enough_square) return true;
        }
    return false;
}

void GroupDistances::take_distances(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        distances_[i] = std::sqrt(double{least_[i / 4][i % 4]}) / scale_;
        seconds_[i] = std::sqrt(double{second_[i / 4][i % 4]}) / scale_;
        triangles_[i] = static_cast<Index>(nearest_[i / 4][i % 4]);
    }
}

/// A triangle farther from the box of the points than this is certainly not the closest of any point.
double GroupDistances::limit() const { return std::sqrt(double{farthest_square()}) / scale_ + 3 * error_; }

/// Compares all points with the triangles below the gathered nodes that may be nearer than the best so far,
/// except leaf `but`. Returns false if so many triangles are left that single queries are as fast.
bool GroupDistances::compare_nearer(std::span<const Vec3> points, const Box& box, std::uint32_t but) {
    constexpr std::size_t most_triangles = 3; // triangles per point
    BoxQuery query(tree_, box, limit());
    children_.clear();
    squares_.clear();
    for (const std::uint32_t leaf : nodes_) {
        if (leaf == but) continue;
        const Float4 squares = query.squares(tree_.node(0, leaf));
        for (unsigned bits = query.near(squares); bits != 0; bits &= bits - 1) {
            const auto lane = static_cast<unsigned>(std::countr_zero(bits));
            children_.push_back(4 * leaf + lane);
            squares_.push_back(squares[lane]);
        }
    }
    if (children_.size() > most_triangles * points.size()) return false;
    float farthest = query.square[0];
    for (std::size_t i = 0; i < children_.size(); ++i) {
        if (!(squares_[i] * (1 - 1e-6F) <= farthest)) continue;
        compare(points, children_[i]);
        farthest = BoxQuery::square_of(tree_, limit());
    }
    return true;
}

bool GroupDistances::measure(std::span<const Vec3> points, Index& hint) {
    done_square_ = -1;
    const Box box = box_around(points);
    const Closest closest = closest_point(tree_, box.centre(), hint);
    if (closest.triangle == none) return false;
    hint = closest.triangle;
    if (!place(points, box.centre(), box.diagonal() + closest.distance)) return false;
    // The triangles of the same leaf lower the limit.
    const std::uint32_t leaf = closest.triangle / 4;
    for (std::size_t t = 4 * std::size_t{leaf}; t < std::min(4 * std::size_t{leaf} + 4, tree_.size()); ++t)
        compare(points, static_cast<Index>(t));
    if (!gather(box, limit(), few_nodes) || !compare_nearer(points, box, leaf)) return false;
    take_distances(points.size());
    return true;
}

/// Squared distances up to this are within the distance despite their error; 0 if the error is larger than
/// the distance.
float GroupDistances::enough_square(double distance) const {
    const double enough = std::max(0.0, (distance - error_) * scale_ * (1 - 1e-6));
    return static_cast<float>(enough * enough);
}

bool GroupDistances::all_within(std::span<const Vec3> points, double distance, Index& hint) {
    distances_.fill(HUGE_VAL); // no point is proved to be near
    if (tree_.empty() || !(distance > 0)) return false;
    const Box box = box_around(points);
    if (!place(points, box.centre(), box.diagonal() + distance)) return false;
    const float square = enough_square(distance);
    if (!(square > 0)) return false;
    done_square_ = square;
    if (hint != none) compare(points, hint);
    bool all = hint != none && farthest_square() <= square;
    if (!all) {
        all = gather(box, distance, few_nodes) && compare_until(square, points, box, distance);
    }
    take_distances(points.size());
    if (all) hint = triangles_[points.size() - 1];
    return all;
}

/// A bit for each point whose squared distance to the triangle is below `square`; complete for points in
/// `among`.
std::uint32_t GroupDistances::which_within(std::span<const Vec3> points, float square, Index triangle,
                                           std::uint32_t among) const {
    std::uint32_t within = 0;
    Flat flat;
    const auto [a, b, c] = tree_.triangle(triangle);
    if (flat.set((a - centre_) * scale_, (b - centre_) * scale_, (c - centre_) * scale_)) {
        for (std::size_t i = 0; i < fours_; ++i)
            if ((among >> 4 * i & 15) != 0)
                within |= bits_of(squares_below(four(square), flat, i) < four(square)) << 4 * i;
    } else {
        for (std::size_t i = 0; i < points.size(); ++i)
            if ((among >> i & 1) != 0)
                within |= std::uint32_t{square_exactly(points[i], triangle) < square} << i;
    }
    return within;
}

bool GroupDistances::lay_out(std::span<const Vec3> points, double distance) {
    if (tree_.empty() || !(distance > 0)) return false;
    const Box box = box_around(points);
    if (!place(points, box.centre(), box.diagonal() + distance)) return false;
    done_square_ = enough_square(distance);
    return done_square_ > 0;
}

/// Finds the nodes whose boxes are within a distance of the box of the points in `among`. Returns false if
/// too many are found.
bool GroupDistances::gather_near(std::span<const Vec3> points, double distance, std::uint32_t among) {
    Box box;
    for (std::uint32_t left = among; left != 0; left &= left - 1)
        box.add(points[static_cast<std::size_t>(std::countr_zero(left))]);
    return gather(box, distance, few_nodes);
}

/// The points within a distance of the box of a node, up to rounding: bit i for the i-th.
std::uint32_t GroupDistances::near_node(std::uint32_t node, double distance) const {
    const FaceTree::Node& boxes = tree_.node(0, node);
    Float4 low[3], high[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto in_group = [&](float x, double off) {
            const double at = double{x} / tree_.scale + tree_.middle[axis] - centre_[axis] + off;
            return four(static_cast<float>(at * scale_));
        };
        low[axis] = in_group(*std::min_element(boxes.min[axis], boxes.min[axis] + 4), -distance);
        high[axis] = in_group(*std::max_element(boxes.max[axis], boxes.max[axis] + 4), distance);
    }
    std::uint32_t near = 0;
    for (std::size_t i = 0; i < fours_; ++i) {
        const Int4 inside = (x_[i] >= low[0]) & (x_[i] <= high[0]) & (y_[i] >= low[1]) & (y_[i] <= high[1]) &
                            (z_[i] >= low[2]) & (z_[i] <= high[2]);
        near |= bits_of(inside) << 4 * i;
    }
    return near;
}

TriangleSlabs GroupDistances::slabs_of(std::uint32_t node) const {
    using Triangle = FaceTree::Triangle;
    std::array<Triangle, 4> in_node; // the last triangle repeats if the node has fewer
    for (std::size_t i = 0; i < 4; ++i)
        in_node[i] = tree_.triangle(std::min(4 * std::size_t{node} + i, tree_.size() - 1));
    const auto rounded = [&](const auto& of) {
        const Vec3 p[] = {of(in_node[0]), of(in_node[1]), of(in_node[2]), of(in_node[3])};
        const auto number = [&](std::size_t i, std::size_t k) {
            return static_cast<float>(p[i][k] * scale_);
        };
        Float4x3 all;
        for (std::size_t k = 0; k < 3; ++k)
            all[k] = Float4{number(0, k), number(1, k), number(2, k), number(3, k)};
        return all;
    };
    return {{rounded([&](const Triangle& t) { return t.a - centre_; }),
             rounded([&](const Triangle& t) { return t.b - centre_; }),
             rounded([&](const Triangle& t) { return t.c - centre_; })},
            {rounded([](const Triangle& t) { return t.b - t.a; }),
             rounded([](const Triangle& t) { return t.c - t.b; }),
             rounded([](const Triangle& t) { return t.a - t.c; })},
            done_square_};
}

/// Returns the untried triangle below the gathered nodes whose box is nearest to a point, or none if its box
/// is beyond the distance. Marks it as tried.
Index GroupDistances::next_near(const Vec3& point, double distance) {
    Box at;
    at.add(point);
    const BoxQuery query(tree_, at, distance);
    Float4 least = four(HUGE_VALF);
    Int4 nodes{};
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const Float4 squares = query.squares(tree_.node(0, nodes_[n])) + tried_[n];
        const Int4 nearer = squares < least;
        least = nearer ? squares : least;
        nodes = nearer ? Int4{} + static_cast<std::int32_t>(n) : nodes;
    }
    unsigned lane = 0;
    for (unsigned i = 1; i < 4; ++i)
        if (least[i] < least[lane]) lane = i;
    if (((query.near(least) >> lane) & 1) == 0) return none;
    const auto n = static_cast<std::size_t>(nodes[lane]);
    tried_[n][lane] = HUGE_VALF;
    return 4 * nodes_[n] + lane;
}

/// A triangle within the distance of all points of a set is also within the distance of their middle. So
/// each set tries triangles, nearest first, and each of these is tested for the other sets as well.
void GroupDistances::remove_within(std::span<const Vec3> points, double distance,
                                   std::vector<std::uint32_t>& sets, Index& hint) {
    if (!lay_out(points, distance)) return;
    const auto remove = [&](Index triangle, std::size_t from) {
        std::uint32_t among = 0;
        for (std::size_t i = from; i < sets.size(); ++i) among |= sets[i];
        const std::uint32_t near = within(points, triangle, among);
        const auto covered = [&](std::uint32_t set) { return (set & ~near) == 0; };
        const auto begin = sets.begin() + static_cast<std::ptrdiff_t>(from);
        const auto end = near == 0 ? sets.end() : std::remove_if(begin, sets.end(), covered);
        if (end == sets.end()) return;
        sets.erase(end, sets.end());
        hint = triangle;
    };
    if (hint != none) remove(hint, 0);
    if (sets.empty() || !gather(box_around(points), distance, many_nodes)) return;
    tried_.assign(nodes_.size(), Float4{});
    for (std::size_t first = 0; first < sets.size();) {
        Vec3 sum;
        for (std::uint32_t left = sets[first]; left != 0; left &= left - 1)
            sum += points[static_cast<std::size_t>(std::countr_zero(left))];
        const Index near = next_near(sum / std::popcount(sets[first]), distance);
        if (near == none)
            ++first; // the set stays, and is not tested again
        else
            remove(near, first);
    }
}

} // namespace facetmill

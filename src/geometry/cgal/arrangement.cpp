#include "geometry/cgal/arrangement.hpp"

#include "base/math/predicates.hpp"
#include "geometry/cgal/plane_cut.hpp"
#include "geometry/cgal/region_fill.hpp"
#include "geometry/intersect/plane_crossing.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>

namespace facetmill {

namespace {

using Quick = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Quick::Point_3, 3>;

Quick::Point_3 quick(const Vec3& p) { return {p.x, p.y, p.z}; }

/// The side of t's plane of each of three points.
std::array<int, 3> sides(const Corners& t, const Corners& points) {
    std::array<int, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) side[i] = CGAL::orientation(t[0], t[1], t[2], points[i]);
    return side;
}

/// Whether a point in the triangle's plane is in the triangle, including its border.
bool holds(const Corners& t, const Quick::Point_3& p) {
    for (std::size_t i = 0; i < 3; ++i)
        if (CGAL::coplanar_orientation(t[i], t[(i + 1) % 3], t[(i + 2) % 3], p) == CGAL::NEGATIVE)
            return false;
    return true;
}

/// Whether the line through a and b passes through the triangle, including its border. a and b are on
/// different sides of its plane.
bool passes_through(const Quick::Point_3& a, const Quick::Point_3& b, const Corners& t) {
    bool left = false, right = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const int side = CGAL::orientation(a, b, t[i], t[(i + 1) % 3]);
        left |= side > 0;
        right |= side < 0;
    }
    return !(left && right);
}

/// Finds the intersections of triangles in different planes, and groups coplanar triangles.
class Meetings {
  public:
    Meetings(const TriangleSoup& soup, ExactNodes& nodes)
        : soup_(soup), nodes_(nodes), place_of_(soup.triangles.size(), none), sets_(soup.cut.size()),
          points_(soup.cut.size()), segments_(soup.cut.size()), flat_(soup.cut.size()) {
        for (Index i = 0; i < soup.cut.size(); ++i) {
            place_of_[soup.cut[i]] = i;
            for (const Index p : soup.triangles[soup.cut[i]]) nodes.know(p);
            const Corners t = corners(soup.cut[i]);
            flat_[i] = CGAL::collinear(t[0], t[1], t[2]);
        }
        find_all();
    }

    /// The groups, sorted by their first triangles.
    std::vector<PlaneGroup> groups() {
        std::map<Index, PlaneGroup> by_set;
        for (Index i = 0; i < soup_.cut.size(); ++i) {
            if (flat_[i]) continue;
            PlaneGroup& g = by_set[sets_.find(i)];
            g.triangles.push_back(soup_.cut[i]);
            g.points.insert(g.points.end(), points_[i].begin(), points_[i].end());
            g.segments.insert(g.segments.end(), segments_[i].begin(), segments_[i].end());
        }
        std::vector<PlaneGroup> all;
        for (auto& [set, g] : by_set) {
            std::sort(g.segments.begin(), g.segments.end());
            const auto is_same = [](const Segment& a, const Segment& b) {
                return a.from == b.from && a.to == b.to;
            };
            g.segments.erase(std::unique(g.segments.begin(), g.segments.end(), is_same), g.segments.end());
            all.push_back(std::move(g));
        }
        return all;
    }

  private:
    Corners corners(Index t) const {
        const auto& [a, b, c] = soup_.triangles[t];
        return {quick(soup_.points[a]), quick(soup_.points[b]), quick(soup_.points[c])};
    }

    /// A corner, or the point where the side from low to high passes through triangle t.
    struct End {
        Index low, high = none, triangle = none;
        bool is_corner() const { return high == none; }
        auto key() const { return std::tuple(low, high, triangle); }
        SideCrossing crossing() const { return {low, high, triangle}; }
    };

    /// The intersection of two triangles.
    struct Meeting {
        bool coplanar = false;
        std::vector<End> ends; ///< ends of the common point or segment; each may occur twice
        std::array<std::vector<Index>, 2>
            corners; ///< corners of each triangle on the other, if one has no area
    };

    /// Pairs are intersected in parallel; the results are applied in their order.
    void find_all() {
        std::vector<Meeting> meetings(soup_.pairs.size());
        parallel_for(
            meetings.size(),
            [&](std::size_t i) { meetings[i] = meeting(soup_.pairs[i].first, soup_.pairs[i].second); }, 256);
        make_crossings(meetings);
        for (std::size_t i = 0; i < meetings.size(); ++i)
            note(place_of_[soup_.pairs[i].first], place_of_[soup_.pairs[i].second], meetings[i]);
    }

    Meeting meeting(Index s, Index t) const {
        Meeting found;
        const Corners a = corners(s), b = corners(t);
        if (const bool flat_s = flat_[place_of_[s]], flat_t = flat_[place_of_[t]]; flat_s || flat_t) {
            if (!flat_t) found.corners[1] = those_on(a, soup_.triangles[s], b);
            if (!flat_s) found.corners[0] = those_on(b, soup_.triangles[t], a);
            return found;
        }
        const auto of_s = sides(b, a);
        found.coplanar = of_s == std::array{0, 0, 0};
        if (found.coplanar) return found;
        collect(s, a, of_s, t, b, found.ends);
        collect(t, b, sides(a, b), s, a, found.ends);
        return found;
    }

    static std::vector<Index> those_on(const Corners& points, const std::array<Index, 3>& nodes,
                                       const Corners& t) {
        std::vector<Index> found;
        const auto side = sides(t, points);
        for (std::size_t k = 0; k < 3; ++k)
            if (side[k] == 0 && holds(t, points[k])) found.push_back(nodes[k]);
        return found;
    }

    /// The ends of the intersection of the sides of s with t.
    void collect(Index s, const Corners& a, const std::array<int, 3>& side, Index t, const Corners& b,
                 std::vector<End>& found) const {
        const auto& nodes = soup_.triangles[s];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (side[k] == 0 && holds(b, a[k])) found.push_back({nodes[k]});
            if (side[k] * side[next] < 0 && passes_through(a[k], a[next], b)) {
                const auto [low, high] = std::minmax(nodes[k], nodes[next]);
                found.push_back({low, high, t});
            }
        }
    }

    /// Makes a node for each crossing, in the order of the pairs. The points are computed in parallel.
    void make_crossings(const std::vector<Meeting>& meetings) {
        std::vector<End> fresh;
        for (const Meeting& m : meetings)
            for (const End& end : m.ends)
                if (!end.is_corner() && known_.try_emplace(end.key(), none).second) fresh.push_back(end);
        std::vector<std::pair<std::optional<ExactNodes::Point>, Vec3>> made(fresh.size());
        parallel_for(
            fresh.size(),
            [&](std::size_t i) {
                auto& [point, place] = made[i];
                if (const auto quick = place_of(fresh[i])) {
                    place = *quick;
                    return;
                }
                point = nodes_.point_of(fresh[i].crossing());
                place = ExactNodes::place_of(*point);
            },
            64);
        for (std::size_t i = 0; i < fresh.size(); ++i)
            known_[fresh[i].key()] =
                nodes_.find_or_add(fresh[i].crossing(), std::move(made[i].first), made[i].second);
    }

    std::optional<Vec3> place_of(const End& end) const {
        const auto& [a, b, c] = soup_.triangles[end.triangle];
        return plane_crossing(soup_.points[end.low], soup_.points[end.high],
                              {soup_.points[a], soup_.points[b], soup_.points[c]});
    }

    void note(Index i, Index j, const Meeting& meeting) {
        if (meeting.coplanar) sets_.join(i, j);
        points_[i].insert(points_[i].end(), meeting.corners[0].begin(), meeting.corners[0].end());
        points_[j].insert(points_[j].end(), meeting.corners[1].begin(), meeting.corners[1].end());
        std::vector<Index> found;
        for (const End& end : meeting.ends)
            found.push_back(end.is_corner() ? end.low : known_.find(end.key())->second);
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        for (const auto& [k, other] : {std::pair{i, j}, std::pair{j, i}}) {
            if (found.size() == 1) points_[k].push_back(found[0]);
            if (found.size() == 2) segments_[k].push_back({found[0], found[1], soup_.cut[other]});
        }
    }

    const TriangleSoup& soup_;
    ExactNodes& nodes_;
    std::vector<Index> place_of_; ///< [triangles] index in cut
    DisjointSets sets_;           ///< sets of coplanar triangles; by index in cut, like the following members
    std::vector<std::vector<Index>> points_;
    std::vector<std::vector<Segment>> segments_;
    std::vector<std::uint8_t> flat_; ///< [cut] 1 for triangles without area
    std::unordered_map<std::tuple<Index, Index, Index>, Index, HashOfIndices> known_;
};

/// An upper bound for crossings of lines in the group: the number of pairs of boxes that meet, counted up to
/// a limit.
std::size_t possible_crossings(const TriangleSoup& soup, const PlaneGroup& group, const ExactNodes& nodes,
                               std::size_t limit) {
    std::vector<std::pair<Index, Index>> lines;
    for (const Segment& s : group.segments) lines.emplace_back(s.from, s.to);
    if (group.triangles.size() > 1)
        for (const Index t : group.triangles)
            for (std::size_t i = 0; i < 3; ++i)
                lines.emplace_back(soup.triangles[t][i], soup.triangles[t][(i + 1) % 3]);
    if (lines.size() < 64) return lines.size() * lines.size() / 2;
    std::vector<Box> boxes(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        boxes[i].add(nodes.rounded(lines[i].first));
        boxes[i].add(nodes.rounded(lines[i].second));
    }
    std::size_t count = 0;
    const BoxTree tree(boxes);
    for (std::size_t i = 0; i < boxes.size() && count <= limit; ++i)
        tree.visit(boxes[i], [&](Index j) { count += j > i; });
    return count;
}

/// Classifies points against a few boxes, each long along an axis: two bits for each box and each of its two
/// other axes. A table over positions along the axis limits comparisons to boxes near the point.
class SlabsAlong {
  public:
    /// places: boxes by the axis along which they are long.
    SlabsAlong(std::size_t axis, const std::array<std::vector<Index>, 3>& places,
               const std::vector<Box>& boxes, const Box& bounds)
        : low_(bounds.min[axis]) {
        const double extent = bounds.max[axis] - low_;
        scale_ = extent > 0 ? static_cast<double>(cells) / extent : 0;
        if (!(scale_ < HUGE_VAL)) scale_ = 0;
        for (std::size_t j = 1; j < 3; ++j)
            for (const Index at : places[(axis + 3 - j) % 3]) {
                slabs_.push_back({boxes[at].min[axis], boxes[at].max[axis], 4 * at + 2 * (j - 1)});
                const auto [low, high, bit] = slabs_.back();
                for (std::size_t c = 0; c < cell(low); ++c) sure_[c] |= std::uint64_t{1} << bit;
                for (std::size_t c = cell(high) + 1; c < cells; ++c) sure_[c] |= std::uint64_t{2} << bit;
                is_near_[cell(low)] = is_near_[cell(high)] = true;
            }
    }

    std::uint64_t beside(double x) const {
        const std::size_t c = cell(x);
        if (!is_near_[c]) return sure_[c];
        std::uint64_t bits = 0;
        for (const auto& [low, high, bit] : slabs_)
            bits |= std::uint64_t{x < low} << bit | std::uint64_t{x > high} << (bit + 1);
        return bits;
    }

  private:
    static constexpr std::size_t cells = 1024;
    struct Slab {
        double low, high;
        std::size_t bit;
    };

    /// The cell of x. Monotonic: never lower for a higher x.
    std::size_t cell(double x) const {
        const double at = (x - low_) * scale_;
        return at < 1 ? 0 : at < static_cast<double>(cells) ? static_cast<std::size_t>(at) : cells - 1;
    }

    double low_, scale_ = 0;
    std::vector<Slab> slabs_;
    std::array<std::uint64_t, cells> sure_{}; ///< [cells] the bits of all points in a cell that is not near
    std::array<bool, cells> is_near_{};       ///< [cells] true if a side of a box is in the cell
};

/// [points] The sides of the boxes on which each point is.
std::vector<std::uint64_t> beside_boxes(const std::vector<Vec3>& points,
                                        const std::array<std::vector<Index>, 3>& places,
                                        const std::vector<Box>& boxes, const Box& bounds) {
    const std::array along{SlabsAlong(0, places, boxes, bounds), SlabsAlong(1, places, boxes, bounds),
                           SlabsAlong(2, places, boxes, bounds)};
    std::vector<std::uint64_t> beside(points.size());
    parallel_for(beside.size(), [&](std::size_t i) {
        const Vec3& p = points[i];
        beside[i] = along[0].beside(p.x) | along[1].beside(p.y) | along[2].beside(p.z);
    });
    return beside;
}

template <class T>
std::vector<T> appended(std::vector<T> all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// The sum over the axes of the box area that a ray along an axis can hit.
double half_area(const Box& box) {
    const Vec3 size = box.max - box.min;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

} // namespace

struct Arrangement::Own {
    explicit Own(TriangleSoup given) : soup(std::move(given)), nodes(soup) {}

    TriangleSoup soup;
    ExactNodes nodes; // refers to the soup's points
    std::vector<Piece> pieces;
    SidesOfNodes sides;
    std::optional<Index> overfull;
    /// Triangles in a row that are near each other, sixteen at most.
    struct Run {
        Box box;
        Index begin = 0, end = 0;
    };
    Box bounds; ///< bounds of all points

    void cut() {
        if (soup.pairs.size() > soup.max_pairs) {
            overfull = most_met();
            return;
        }
        const auto groups = Meetings(soup, nodes).groups();
        std::size_t possible = 0, worst = 0;
        for (const PlaneGroup& g : groups) {
            const std::size_t count = possible_crossings(soup, g, nodes, soup.max_crossings);
            if (count > worst) {
                worst = count;
                overfull = g.triangles.front();
            }
            possible += count;
        }
        if (possible > soup.max_crossings) return;
        overfull.reset();
        cut_in_planes(soup, groups, nodes, pieces, sides);
    }

    /// The triangle in the most pairs.
    Index most_met() const {
        std::vector<Index> count(soup.triangles.size(), 0);
        for (const auto& [s, t] : soup.pairs) {
            ++count[s];
            ++count[t];
        }
        return static_cast<Index>(std::max_element(count.begin(), count.end()) - count.begin());
    }

    Box box_of(Index t) const {
        Box box;
        for (const Index p : soup.triangles[t]) box.add(soup.points[p]);
        return box;
    }

    /// Appends the triangles from begin to end as one run. Splits them into several runs if their common box
    /// would be much larger than the sum of their boxes. Otherwise many rays would enter the common box
    /// without a hit. Returns the box of all.
    Box add_runs(Index begin, Index end, std::vector<Run>& all) const {
        if (end - begin == 1) return all.emplace_back(Run{box_of(begin), begin, end}).box;
        const std::size_t before = all.size();
        const Index middle = begin + (end - begin) / 2;
        const Box left = add_runs(begin, middle, all), right = add_runs(middle, end, all);
        Box both = left;
        both.add(right);
        if (all.size() == before + 2 && !(half_area(both) > 2 * (half_area(left) + half_area(right)))) {
            all.pop_back();
            all.back() = {both, begin, end};
        }
        return both;
    }

    std::vector<Run> runs_of_all() const {
        constexpr std::size_t longest = 16;
        const std::size_t count = soup.triangles.size();
        const auto among = [&](std::size_t first, std::size_t last) {
            std::vector<Run> some;
            for (std::size_t begin = first * longest; begin < std::min(count, last * longest);
                 begin += longest)
                add_runs(static_cast<Index>(begin), static_cast<Index>(std::min(count, begin + longest)),
                         some);
            return some;
        };
        return parallel_reduce((count + longest - 1) / longest, std::vector<Run>{}, among, appended<Run>,
                               512);
    }

    using Pairs = std::vector<std::pair<Index, Index>>; ///< (triangle, box)

    /// The triangles whose boxes meet any of these boxes, each with the index of its box; ascending for each
    /// index. Four bits of each point classify it against a box, along the axes that the box is not long on.
    /// So only points are compared, and triangles combine bits.
    Pairs meetings_of_few(const std::array<std::vector<Index>, 3>& places,
                          const std::vector<Box>& boxes) const {
        const std::vector<std::uint64_t> beside = beside_boxes(soup.points, places, boxes, bounds);
        constexpr std::uint64_t lowest_of_four = 0x1111'1111'1111'1111;
        const std::uint64_t used = lowest_of_four >> (64 - 4 * boxes.size());
        const auto among = [&](std::size_t first, std::size_t last) {
            Pairs pairs;
            for (auto t = static_cast<Index>(first); t < last; ++t) {
                const auto& [a, b, c] = soup.triangles[t];
                std::uint64_t apart = beside[a] & beside[b] & beside[c];
                apart |= apart >> 2;
                apart |= apart >> 1;
                for (std::uint64_t left = ~apart & used; left != 0; left &= left - 1) {
                    const auto at = static_cast<Index>(std::countr_zero(left) / 4);
                    if (boxes_meet(box_of(t), boxes[at])) pairs.emplace_back(t, at);
                }
            }
            return pairs;
        };
        return parallel_reduce(soup.triangles.size(), Pairs{}, among, appended<Pairs::value_type>);
    }

    /// The triangles whose boxes meet any of these boxes, for many boxes. Boxes that are long along the same
    /// axis share a tree.
    Pairs meetings(const std::array<std::vector<Index>, 3>& places, const std::vector<Box>& boxes) const {
        constexpr std::size_t few = 16; // four bits for each box fit into 64 bits
        if (boxes.size() <= few) return meetings_of_few(places, boxes);
        const std::vector<Run> runs = runs_of_all();
        std::vector<BoxTree> trees;
        for (const auto& of_one : places) {
            std::vector<Box> long_one_way;
            for (const Index at : of_one) long_one_way.push_back(boxes[at]);
            trees.emplace_back(std::move(long_one_way));
        }
        const auto among = [&](std::size_t first, std::size_t last) {
            Pairs pairs;
            for (std::size_t i = first; i < last; ++i)
                for (std::size_t k = 0; k < trees.size(); ++k)
                    trees[k].visit(runs[i].box, [&](Index item) {
                        const Index at = places[k][item];
                        for (Index t = runs[i].begin; t < runs[i].end; ++t)
                            if (boxes_meet(box_of(t), boxes[at])) pairs.emplace_back(t, at);
                    });
            return pairs;
        };
        return parallel_reduce(runs.size(), Pairs{}, among, appended<Pairs::value_type>, 512);
    }
};

Arrangement::Arrangement(TriangleSoup soup) : own_(std::make_unique<Own>(std::move(soup))) {
    own_->cut();
    for (const Vec3& p : own_->soup.points) own_->bounds.add(p);
}
Arrangement::~Arrangement() = default;

std::optional<Index> Arrangement::overfull() const { return own_->overfull; }
const std::vector<Arrangement::Piece>& Arrangement::pieces() const { return own_->pieces; }
Vec3 Arrangement::position(Index node) const { return own_->nodes.rounded(node); }
std::size_t Arrangement::node_count() const { return own_->nodes.size(); }
std::optional<int> Arrangement::side_of(Index triangle, Index node) const {
    const auto at = own_->sides.find({triangle, node});
    return at == own_->sides.end() ? std::nullopt : std::optional(at->second);
}

std::vector<std::optional<std::vector<std::array<Index, 3>>>>
Arrangement::fill(const std::vector<Region>& regions) const {
    std::vector<std::optional<std::vector<std::array<Index, 3>>>> filled(regions.size());
    parallel_for(
        regions.size(), [&](std::size_t i) { filled[i] = fill_region(own_->nodes, regions[i]); }, 16);
    return filled;
}

namespace {

using Point = ExactNodes::Point;

/// A ray along an axis, moved aside by less than any distance: by e along the next axis and e * e along the
/// one after.
struct Ray {
    Point from;
    Box around; ///< bounds of `from` in doubles
    int axis;
    bool forward;

    /// The side of the line from a to b that contains the ray, seen along the axis.
    int side(const Vec3& a, const Vec3& b) const {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto i = static_cast<std::size_t>(u), j = static_cast<std::size_t>(v);
        if (const int sure = sure_side(a, b, i, j)) return sure;
        using Flat = ExactKernel::Point_2;
        const int exact = CGAL::orientation(Flat(a[i], a[j]), Flat(b[i], b[j]), Flat(from[u], from[v]));
        if (exact != 0) return exact;
        if (a[j] != b[j]) return a[j] > b[j] ? 1 : -1;
        return a[i] < b[i] ? 1 : a[i] > b[i] ? -1 : 0;
    }

    /// The side by rounded numbers, or 0 if uncertain. Products of differences have a relative error below
    /// 1e-15, and the error of `from` is at most the size of its bounding box.
    int sure_side(const Vec3& a, const Vec3& b, std::size_t i, std::size_t j) const {
        const double x = b[i] - a[i], y = b[j] - a[j];
        const double left = x * (around.min[j] - a[j]), right = y * (around.min[i] - a[i]);
        const double off =
            std::abs(x) * (around.max[j] - around.min[j]) + std::abs(y) * (around.max[i] - around.min[i]);
        const double bound = 1e-15 * (std::abs(left) + std::abs(right)) + 1.01 * off + orientation_smallest;
        const double area = left - right;
        return area > bound ? 1 : area < -bound ? -1 : 0;
    }

    /// 1 if the ray leaves through the front of the triangle, -1 if it enters, 0 if it does not pass
    /// through.
    int passes(const Vec3& a, const Vec3& b, const Vec3& c) const {
        const int turn = side(a, b);
        if (turn == 0 || side(b, c) != turn || side(c, a) != turn) return 0;
        const auto exact = [](const Vec3& p) { return Point(p.x, p.y, p.z); };
        const int above = turn * CGAL::orientation(exact(a), exact(b), exact(c), from);
        if (above == 0 || (above < 0) != forward) return 0;
        return forward ? turn : -turn;
    }
};

/// A ray from the centre of three nodes along an axis that is not in their plane, to the outside of the box.
struct Sight {
    Ray ray;
    Box along; ///< contains the ray as far as the triangles reach
    int way;   ///< see Arrangement::Seen

    Sight(const ExactNodes& nodes, const std::array<Index, 3>& from, const Box& bounds) {
        const auto p = nodes.at(from[0]), q = nodes.at(from[1]), r = nodes.at(from[2]);
        const auto normal = CGAL::cross_product(q - p, r - p);
        const Vec3 a = nodes.rounded(from[0]),
                   rough = cross(nodes.rounded(from[1]) - a, nodes.rounded(from[2]) - a);
        std::array<int, 3> axes{0, 1, 2};
        std::stable_sort(axes.begin(), axes.end(), [&](int i, int j) {
            return std::abs(rough[static_cast<std::size_t>(i)]) >
                   std::abs(rough[static_cast<std::size_t>(j)]);
        });
        const int axis =
            *std::find_if(axes.begin(), axes.end(), [&](int i) { return !CGAL::is_zero(normal[i]); });
        const auto k = static_cast<std::size_t>(axis);
        ray = {CGAL::centroid(p, q, r), {}, axis, a[k] > bounds.centre()[k]};
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = CGAL::to_interval(ray.from[i]);
            along.min[static_cast<std::size_t>(i)] = low;
            along.max[static_cast<std::size_t>(i)] = high;
        }
        ray.around = along;
        if (ray.forward)
            along.max[k] = std::max(along.max[k], bounds.max[k]);
        else
            along.min[k] = std::min(along.min[k], bounds.min[k]);
        way = CGAL::is_positive(normal[axis]) == ray.forward ? 1 : -1;
    }
};

} // namespace

std::vector<Arrangement::Seen> Arrangement::look_ahead(const std::vector<Look>& looks) const {
    std::vector<Seen> seen(looks.size());
    std::vector<Sight> sights;
    std::vector<Box> boxes;
    std::array<std::vector<Index>, 3> along; // each axis
    for (std::size_t i = 0; i < looks.size(); ++i) {
        sights.emplace_back(own_->nodes, looks[i].nodes, own_->bounds);
        boxes.push_back(sights.back().along);
        along[static_cast<std::size_t>(sights.back().ray.axis)].push_back(static_cast<Index>(i));
        seen[i].way = sights.back().way;
    }
    if (looks.empty()) return seen;
    const auto& soup = own_->soup;
    for (const auto& [t, i] : own_->meetings(along, boxes)) {
        const auto& but = looks[i].but;
        if (std::find(but.begin(), but.end(), t) != but.end()) continue;
        const auto& [a, b, c] = soup.triangles[t];
        if (const int way = sights[i].ray.passes(soup.points[a], soup.points[b], soup.points[c]))
            seen[i].hits.push_back({t, way});
    }
    return seen;
}

} // namespace facetmill

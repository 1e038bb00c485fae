#include "io/footprint/chains.hpp"

#include "geometry/polygon/ring_tree.hpp"
#include "io/text.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace facetmill::io {

namespace {

using polygon::turn;
using Bounds = polygon::RingTree::Bounds;

struct NearPair {
    double distance = 0;
    Index a = 0, b = 0;
};

/// Pairs of points that are no farther apart than the larger reach, the nearest first.
std::vector<NearPair> near_pairs(const std::vector<Vec2>& points, const std::vector<double>& reaches,
                                 const std::string& name) {
    struct Cell {
        double x, y;
        Index point;
        auto operator<=>(const Cell&) const = default;
    };
    const double width = points.empty() ? 0 : *std::max_element(reaches.begin(), reaches.end());
    std::vector<NearPair> pairs;
    if (!(width > 0)) return pairs;
    std::vector<Cell> cells;
    cells.reserve(points.size());
    for (Index i = 0; i < points.size(); ++i)
        cells.push_back({std::floor(points[i].x / width), std::floor(points[i].y / width), i});
    std::sort(cells.begin(), cells.end());
    std::size_t compared = 0;
    constexpr std::size_t most = 100'000'000;
    for (const Cell& c : cells)
        for (const double dx : {0.0, 1.0}) {
            auto other = std::lower_bound(cells.begin(), cells.end(), Cell{c.x + dx, c.y - 1, 0});
            for (; other != cells.end() && other->x == c.x + dx && other->y <= c.y + 1; ++other) {
                if (++compared > most) beyond_limit(name, "too many lines end at the same position");
                if (dx == 0 && other->point == c.point) continue;
                const Index a = std::min(c.point, other->point), b = std::max(c.point, other->point);
                const double d = length(points[b] - points[a]);
                if (d <= std::max(reaches[a], reaches[b])) pairs.push_back({d, a, b});
            }
        }
    const auto key = [](const NearPair& p) { return std::tuple(p.distance, p.a, p.b); };
    std::sort(pairs.begin(), pairs.end(), [&](const auto& p, const auto& q) { return key(p) < key(q); });
    const auto same = [&](const auto& p, const auto& q) { return key(p) == key(q); };
    pairs.erase(std::unique(pairs.begin(), pairs.end(), same), pairs.end());
    return pairs;
}

/// The meaning of 1e-5: see join_chains.
constexpr double rounding = 1e-5;

/// Some curves, and the nodes at which their ends meet. Curves are numbered as given. End 2c is the first
/// point of curve c, 2c + 1 its last.
class EndGraph {
  public:
    EndGraph(const std::vector<OpenCurve>& all, const std::vector<Index>& some, const std::string& name)
        : name_(name), some_(some.size()), node_(2 * some.size(), none) {
        curves_.reserve(some.size());
        for (const Index c : some) curves_.push_back(&all[c]);
        std::iota(some_.begin(), some_.end(), Index{0});
        join_equal_ends();
        remove_repeated();
        join_near_ends();
        remove_repeated();
    }

    /// Curves that were left out, because they lie on another one.
    std::size_t repeated() const { return repeated_; }

    /// Removes curves with an end that meets no other, one after the other, and returns them.
    std::vector<Index> remove_dangling() {
        find_ends();
        std::vector<bool> removed(curves_.size(), false);
        std::vector<std::size_t> degrees(ends_at_.size());
        std::vector<Index> dangling, loose;
        for (Index n = 0; n < ends_at_.size(); ++n) {
            degrees[n] = ends_at_[n].size();
            if (degrees[n] == 1) loose.push_back(n);
        }
        while (!loose.empty()) {
            const Index n = loose.back();
            loose.pop_back();
            for (const Index e : ends_at_[n]) {
                if (removed[e / 2]) continue;
                removed[e / 2] = true;
                dangling.push_back(e / 2);
                --degrees[n];
                if (--degrees[node_[e ^ 1]] == 1) loose.push_back(node_[e ^ 1]);
            }
        }
        std::erase_if(some_, [&](Index c) { return removed[c]; });
        return dangling;
    }

    /// Removes connected curves of which an odd number of ends meets somewhere, and returns them. at: the
    /// first such place.
    std::vector<Index> remove_branching(std::optional<Vec2>& at) {
        find_ends();
        DisjointSets sets(ends_at_.size());
        for (const Index c : some_) sets.join(node_[2 * c], node_[2 * c + 1]);
        std::vector<bool> branching(ends_at_.size(), false);
        for (Index n = 0; n < ends_at_.size(); ++n)
            if (ends_at_[n].size() % 2 != 0) {
                branching[sets.find(n)] = true;
                if (!at) at = points_[n];
            }
        std::vector<Index> removed;
        std::erase_if(some_, [&](Index c) {
            if (!branching[sets.find(node_[2 * c])]) return false;
            removed.push_back(c);
            return true;
        });
        return removed;
    }

    /// Rings through all curves; an even number of ends meets everywhere. At a node, ends that are neighbours
    /// by angle are joined, so that rings do not cross at the node.
    std::vector<std::vector<Vec2>> rings() {
        find_ends();
        std::vector<Index> mate(node_.size(), none);
        for (Index n = 0; n < ends_at_.size(); ++n) {
            auto& ends = ends_at_[n];
            std::sort(ends.begin(), ends.end(), [&](Index a, Index b) { return is_before(n, a, b); });
            for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
                mate[ends[i]] = ends[i + 1];
                mate[ends[i + 1]] = ends[i];
            }
        }
        std::vector<std::vector<Vec2>> rings;
        std::vector<bool> used(curves_.size(), false);
        std::vector<Index> cycle;
        for (const Index c : some_) {
            if (used[c]) continue;
            cycle.clear();
            for (Index e = 2 * c; !used[e / 2]; e = mate[e ^ 1]) {
                used[e / 2] = true;
                cycle.push_back(e);
            }
            split(cycle, rings);
        }
        return rings;
    }

    std::optional<OpenOutline> near_gap();
    std::optional<OpenOutline> chain_around(const std::vector<std::vector<Vec2>>& rings);

  private:
    const Vec2& end_point(Index e) const {
        const auto& points = curves_[e / 2]->points;
        return e % 2 == 0 ? points.front() : points.back();
    }
    const Vec2& point_next_to(Index e) const {
        const auto& points = curves_[e / 2]->points;
        return e % 2 == 0 ? points[1] : points[points.size() - 2];
    }

    void remove_repeated() {
        repeated_ += some_.size();
        std::sort(some_.begin(), some_.end(), [&](Index a, Index b) { return key(a) < key(b); });
        const auto same = [&](Index a, Index b) { return lie_on_each_other(a, b); };
        some_.erase(std::unique(some_.begin(), some_.end(), same), some_.end());
        std::sort(some_.begin(), some_.end());
        repeated_ -= some_.size();
    }

    void join_equal_ends() {
        std::vector<Index> ends;
        ends.reserve(2 * some_.size());
        for (const Index c : some_) ends.insert(ends.end(), {2 * c, 2 * c + 1});
        const auto place = [&](Index e) { return std::pair(end_point(e).x, end_point(e).y); };
        std::sort(ends.begin(), ends.end(),
                  [&](Index a, Index b) { return std::pair(place(a), a) < std::pair(place(b), b); });
        for (std::size_t i = 0; i < ends.size(); ++i) {
            if (i == 0 || place(ends[i]) != place(ends[i - 1])) points_.push_back(end_point(ends[i]));
            node_[ends[i]] = static_cast<Index>(points_.size() - 1);
        }
    }

    /// Joins nodes where an odd number of ends meets.
    void join_near_ends() {
        find_ends();
        std::vector<Index> odd;
        std::vector<Vec2> places;
        std::vector<double> reaches;
        for (Index n = 0; n < ends_at_.size(); ++n) {
            if (ends_at_[n].size() % 2 == 0) continue;
            odd.push_back(n);
            places.push_back(points_[n]);
            double size = 0;
            for (const Index e : ends_at_[n]) size = std::max(size, curves_[e / 2]->size);
            reaches.push_back(rounding * size);
        }
        std::vector<bool> joined(odd.size(), false);
        for (const NearPair& p : near_pairs(places, reaches, name_)) {
            if (joined[p.a] || joined[p.b]) continue;
            joined[p.a] = joined[p.b] = true;
            for (const Index e : ends_at_[odd[p.b]]) node_[e] = odd[p.a];
        }
    }

    void find_ends() {
        ends_at_.assign(points_.size(), {});
        for (const Index c : some_)
            for (const Index e : {2 * c, 2 * c + 1}) ends_at_[node_[e]].push_back(e);
    }

    std::tuple<Index, Index, std::size_t, double, double, Index> key(Index c) const {
        const auto& points = curves_[c]->points;
        const Index a = node_[2 * c], b = node_[2 * c + 1];
        const Vec2 &low = points[(points.size() - 1) / 2], &high = points[points.size() / 2];
        const Vec2 sum = low + high; // the same in both directions
        return {std::min(a, b), std::max(a, b), points.size(), sum.x, sum.y, c};
    }
    bool lie_on_each_other(Index a, Index b) const {
        const auto &p = curves_[a]->points, &q = curves_[b]->points;
        const bool same = node_[2 * a] == node_[2 * b] && node_[2 * a + 1] == node_[2 * b + 1],
                   reversed = node_[2 * a] == node_[2 * b + 1] && node_[2 * a + 1] == node_[2 * b];
        if (p.size() != q.size() || (!same && !reversed)) return false;
        const double off = rounding * std::max(curves_[a]->size, curves_[b]->size);
        const auto near = [&](bool back) {
            for (std::size_t i = 0; i < p.size(); ++i)
                if (!(length(p[i] - q[back ? q.size() - 1 - i : i]) <= off)) return false;
            return true;
        };
        return (same && near(false)) || (reversed && near(true));
    }

    /// Whether the curve of end a leaves a node at a smaller angle than the curve of end b.
    bool is_before(Index node, Index a, Index b) const {
        const Vec2 &at = points_[node], &p = point_next_to(a), &q = point_next_to(b);
        const auto is_lower = [&](const Vec2& r) { return r.y < at.y || (r.y == at.y && r.x < at.x); };
        if (is_lower(p) != is_lower(q)) return is_lower(q);
        const int side = turn(at, p, q);
        return side != 0 ? side > 0 : a < b;
    }

    /// Appends the rings of a closed walk, which is cut where it meets itself.
    void split(const std::vector<Index>& cycle, std::vector<std::vector<Vec2>>& rings) {
        std::vector<Index> path;
        position_.resize(points_.size(), none);
        const auto take = [&](std::size_t from) {
            auto& ring = rings.emplace_back();
            for (std::size_t i = from; i < path.size(); ++i) {
                const auto& points = curves_[path[i] / 2]->points;
                position_[node_[path[i]]] = none;
                ring.push_back(points_[node_[path[i]]]);
                for (std::size_t k = 1; k + 1 < points.size(); ++k)
                    ring.push_back(path[i] % 2 == 0 ? points[k] : points[points.size() - 1 - k]);
            }
            path.resize(from);
        };
        for (const Index e : cycle) {
            const Index at = position_[node_[e]];
            if (at != none) take(at);
            position_[node_[e]] = static_cast<Index>(path.size());
            path.push_back(e);
        }
        take(0);
    }

    /// The curves of a chain from a loose end, or none if it branches. Each end is the first of its curve.
    std::vector<Index> chain_from(Index loose_end) const {
        std::vector<Index> chain{loose_end};
        for (;;) {
            const Index far = chain.back() ^ 1;
            const auto& ends = ends_at_[node_[far]];
            if (ends.size() == 1) return chain;
            if (ends.size() != 2) return {};
            chain.push_back(ends[0] == far ? ends[1] : ends[0]);
        }
    }

    const std::string& name_;
    std::vector<const OpenCurve*> curves_;
    std::vector<Index> some_;  ///< the curves that are left
    std::vector<Index> node_;  ///< [ends]
    std::vector<Vec2> points_; ///< [nodes]
    std::size_t repeated_ = 0;
    std::vector<std::vector<Index>> ends_at_;
    std::vector<Index> position_; ///< [nodes] in the path of split
};

/// Two loose ends that are nearer than a hundredth of their connected curves. Their curves must not run side
/// by side, as the lines of a hatch do.
std::optional<OpenOutline> EndGraph::near_gap() {
    constexpr double part = 0.01;
    constexpr double side_by_side = -0.9; // the cosine of their directions
    find_ends();
    DisjointSets sets(points_.size());
    for (const Index c : some_) sets.join(node_[2 * c], node_[2 * c + 1]);
    std::vector<Bounds> bounds(points_.size());
    for (const Index c : some_)
        for (const Vec2& p : curves_[c]->points) bounds[sets.find(node_[2 * c])].add(p);
    std::vector<Index> loose;
    std::vector<Vec2> places;
    std::vector<double> reaches;
    for (Index n = 0; n < points_.size(); ++n) {
        if (ends_at_[n].size() != 1) continue;
        const auto& b = bounds[sets.find(n)];
        loose.push_back(ends_at_[n][0]);
        places.push_back(points_[n]);
        reaches.push_back(part * length(Vec2{b.x1 - b.x0, b.y1 - b.y0}));
    }
    for (const NearPair& p : near_pairs(places, reaches, name_)) {
        if (p.distance > std::min(reaches[p.a], reaches[p.b])) continue;
        const Vec2 out = places[p.a] - point_next_to(loose[p.a]),
                   in = point_next_to(loose[p.b]) - places[p.b];
        if (dot(out, in) > side_by_side * (length(out) * length(in)))
            return OpenOutline{places[p.a], places[p.b]};
    }
    return {};
}

bool is_outermost(const std::vector<Vec2>& ring, const std::vector<std::vector<Vec2>>& rings) {
    return std::none_of(rings.begin(), rings.end(), [&](const auto& other) {
        return &other != &ring && polygon::locate(ring[0], other) == polygon::PointLocation::inside;
    });
}

/// A chain with two loose ends that encloses an outermost ring if a line of at most half the chain's length
/// closes it.
std::optional<OpenOutline> EndGraph::chain_around(const std::vector<std::vector<Vec2>>& rings) {
    find_ends();
    for (Index n = 0; n < points_.size(); ++n) {
        if (ends_at_[n].size() != 1) continue;
        const auto chain = chain_from(ends_at_[n][0]);
        if (chain.empty() || node_[chain.back() ^ 1] < n) continue; // seen from its other end
        std::vector<Vec2> line;
        for (const Index e : chain) {
            const auto& points = curves_[e / 2]->points;
            if (e % 2 == 0)
                line.insert(line.end(), points.begin(), points.end());
            else
                line.insert(line.end(), points.rbegin(), points.rend());
        }
        double along = 0;
        for (std::size_t i = 1; i < line.size(); ++i) along += length(line[i] - line[i - 1]);
        if (length(line.front() - line.back()) > along / 2) continue;
        Bounds bounds;
        for (const Vec2& p : line) bounds.add(p);
        for (const auto& ring : rings) {
            const Vec2& p = ring[0];
            const bool inside = bounds.meets({p.x, p.y, p.x, p.y}) &&
                                polygon::locate(p, line) == polygon::PointLocation::inside;
            if (inside && is_outermost(ring, rings)) return OpenOutline{line.front(), line.back()};
        }
    }
    return {};
}

void append(std::vector<Index>& all, const std::vector<Index>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

double distance_to(const polygon::RingEdge& e, const Vec2& p) {
    const Vec2 d = e.b - e.a, to = p - e.a;
    const double square = dot(d, d), t = square > 0 ? std::clamp(dot(to, d) / square, 0.0, 1.0) : 0;
    return length(to - d * t);
}

/// Whether the corners and the middles of all edges of a ring are within this distance of the edges of
/// another.
bool lies_on(const std::vector<Vec2>& ring, const std::vector<Vec2>& other, double off) {
    const polygon::Ring span = other;
    const polygon::RingTree tree(polygon::Rings(&span, 1));
    const auto is_near = [&](const Vec2& p) {
        bool near = false;
        tree.query({p.x - off, p.y - off, p.x + off, p.y + off}, [&](Index e) {
            near = distance_to(tree.edges()[e], p) <= off;
            return !near;
        });
        return near;
    };
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2& next = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (!is_near(ring[i]) || !is_near((ring[i] + next) * 0.5)) return false;
    }
    return true;
}

} // namespace

std::size_t remove_repeated(std::vector<std::vector<Vec2>>& rings) {
    std::vector<Bounds> bounds(rings.size());
    std::vector<Index> by_left(rings.size());
    for (Index i = 0; i < rings.size(); ++i) {
        for (const Vec2& p : rings[i]) bounds[i].add(p);
        by_left[i] = i;
    }
    std::sort(by_left.begin(), by_left.end(),
              [&](Index a, Index b) { return std::pair(bounds[a].x0, a) < std::pair(bounds[b].x0, b); });
    std::vector<bool> repeated(rings.size(), false);
    for (std::size_t i = 0; i < by_left.size(); ++i) {
        const Index a = by_left[i];
        const Bounds& p = bounds[a];
        const double off = rounding * length(Vec2{p.x1 - p.x0, p.y1 - p.y0});
        for (std::size_t k = i + 1; k < by_left.size() && !(bounds[by_left[k]].x0 - p.x0 > off); ++k) {
            const Index b = by_left[k];
            const Bounds& q = bounds[b];
            if (repeated[a] || repeated[b]) continue;
            if (!(q.x1 - p.x1 <= off && p.x1 - q.x1 <= off && q.y0 - p.y0 <= off && p.y0 - q.y0 <= off &&
                  q.y1 - p.y1 <= off && p.y1 - q.y1 <= off))
                continue;
            if (lies_on(rings[a], rings[b], off) && lies_on(rings[b], rings[a], off))
                repeated[std::max(a, b)] = true;
        }
    }
    std::size_t kept = 0;
    for (Index i = 0; i < rings.size(); ++i)
        if (!repeated[i]) {
            if (kept != i) rings[kept] = std::move(rings[i]);
            ++kept;
        }
    const std::size_t count = rings.size() - kept;
    rings.resize(kept);
    return count;
}

Chains join_chains(const std::vector<OpenCurve>& curves, const std::vector<std::vector<Vec2>>& others,
                   const std::string& name) {
    Chains result;
    result.rings = others;
    // Returns the curves in no ring.
    const auto join = [&](const std::vector<Index>& some, std::optional<Vec2>& branching) {
        EndGraph graph(curves, some, name);
        result.repeated += graph.repeated();
        std::vector<Index> rest = graph.remove_dangling();
        append(rest, graph.remove_branching(branching));
        for (auto& ring : graph.rings()) result.rings.push_back(std::move(ring));
        for (Index& c : rest) c = some[c];
        std::sort(rest.begin(), rest.end());
        return rest;
    };
    std::vector<Index> by_layer(curves.size()), rest;
    std::iota(by_layer.begin(), by_layer.end(), Index{0});
    const auto layer = [&](Index c) { return curves[c].layer; };
    std::stable_sort(by_layer.begin(), by_layer.end(), [&](Index a, Index b) { return layer(a) < layer(b); });
    for (auto first = by_layer.begin(); first != by_layer.end();) {
        const auto end =
            std::find_if(first, by_layer.end(), [&](Index c) { return layer(c) != layer(*first); });
        std::optional<Vec2> ignored; // curves of other layers may solve it
        append(rest, join({first, end}, ignored));
        first = end;
    }
    std::sort(rest.begin(), rest.end());
    result.open = join(rest, result.branching);
    EndGraph open(curves, result.open, name);
    result.doubtful = open.near_gap();
    if (!result.doubtful) result.doubtful = open.chain_around(result.rings);
    return result;
}

} // namespace facetmill::io

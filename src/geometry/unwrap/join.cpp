#include "geometry/unwrap/join.hpp"

#include "geometry/unwrap/hull.hpp"
#include "parallel/parallel.hpp"

#include <unordered_set>

namespace facetmill::unwrap_room {

namespace {

/// The gap between two charts that are placed side by side, as a share of the side of the smaller.
constexpr double widest_gap = 0.15;
/// The least share of its convex hull that a joined chart fills, so that it packs well; less for charts
/// below this share of the whole area, whose gaps hardly count.
constexpr double least_solid = 0.7, least_solid_small = 0.55, small_share = 0.03;
/// Joined charts with more than this share of the whole area must fill this much of their rectangle.
constexpr double large_share = 0.2, least_filled = 0.75;
/// The longest side of a joined chart, as a share of the side of a square with the whole area.
constexpr double longest_side = 0.9;
constexpr int rounds_joined = 6;

/// A piece of the border between two charts, seen from the lower one.
struct SharedEdge {
    std::uint64_t pair; ///< numbers of the charts
    Index corner;       ///< in the lower chart
};

/// A pair of neighbours, with the edges [begin, end) between them.
struct Pair {
    Index a, b;
    std::size_t begin, end;
    double cost;
};

struct Motion {
    double c = 1, s = 0;
    Vec2 from, to;
    Vec2 operator()(const Vec2& p) const {
        const Vec2 d = p - from;
        return {c * d.x - s * d.y + to.x, s * d.x + c * d.y + to.y};
    }
};

class Joiner {
  public:
    Joiner(const UnwrapSurface& surface, double max_stretch, ChartSet& set)
        : surface_(surface), max_stretch_(max_stretch), charts_(set.charts), gluing_(set.gluing),
          chart_of_(surface.face_count(), none) {
        number_.resize(charts_.size());
        for (Index i = 0; i < charts_.size(); ++i) {
            number_[i] = next_number_++;
            whole_area_ += charts_[i].measure.area;
            for (const Index f : charts_[i].faces) chart_of_[f] = i;
        }
    }

    void run() {
        find_shared();
        while (join_round()) {
        }
        std::erase_if(charts_, [](const Chart& c) { return c.faces.empty(); });
    }

  private:
    void find_shared() {
        for (Index c = 0; c < surface_.twin.size(); ++c)
            if (surface_.twin[c] != none && chart_of_[c / 3] != chart_of_[surface_.twin[c] / 3])
                shared_.push_back({0, c});
    }

    void sort_shared() {
        std::erase_if(shared_, [&](const SharedEdge& e) {
            return chart_of_[e.corner / 3] == chart_of_[surface_.twin[e.corner] / 3];
        });
        for (SharedEdge& e : shared_) {
            Index a = chart_of_[e.corner / 3], b = chart_of_[surface_.twin[e.corner] / 3];
            if (a > b) {
                e.corner = surface_.twin[e.corner];
                std::swap(a, b);
            }
            e.pair = std::uint64_t{a} << 32 | b;
        }
        radix_sort(shared_, [](const SharedEdge& e) { return e.pair; });
        // Both corners of an edge lead here.
        std::vector<SharedEdge> once;
        once.reserve(shared_.size());
        for (std::size_t begin = 0, end = 0; begin < shared_.size(); begin = end) {
            while (end < shared_.size() && shared_[end].pair == shared_[begin].pair) ++end;
            std::sort(shared_.begin() + static_cast<std::ptrdiff_t>(begin),
                      shared_.begin() + static_cast<std::ptrdiff_t>(end),
                      [](const SharedEdge& x, const SharedEdge& y) { return x.corner < y.corner; });
            for (std::size_t i = begin; i < end; ++i)
                if (i == begin || shared_[i].corner != shared_[i - 1].corner) once.push_back(shared_[i]);
        }
        shared_ = std::move(once);
    }

    std::uint64_t key(const Pair& p) const { return std::uint64_t{number_[p.a]} << 32 | number_[p.b]; }

    std::vector<Pair> pairs() const {
        std::vector<Pair> list;
        for (std::size_t begin = 0, end = 0; begin < shared_.size(); begin = end) {
            double shared = 0;
            while (end < shared_.size() && shared_[end].pair == shared_[begin].pair)
                shared += surface_.edge_length(shared_[end++].corner);
            Pair p{static_cast<Index>(shared_[begin].pair >> 32), static_cast<Index>(shared_[begin].pair),
                   begin, end, 0};
            if (failed_.contains(key(p)) || !(shared > 0)) continue;
            const Chart &a = charts_[p.a], &b = charts_[p.b];
            p.cost = std::min(a.measure.area, b.measure.area) * std::min(a.perimeter, b.perimeter) / shared;
            list.push_back(p);
        }
        return list;
    }

    /// Tries the pairs in which each is the best partner of the other. Returns whether any was tried.
    bool join_round() {
        sort_shared();
        const std::vector<Pair> all = pairs();
        std::vector<Index> best(charts_.size(), none);
        const auto is_better = [&](Index p, Index q) {
            return q == none || all[p].cost < all[q].cost || (all[p].cost == all[q].cost && p < q);
        };
        for (Index p = 0; p < all.size(); ++p)
            for (const Index chart : {all[p].a, all[p].b})
                if (is_better(p, best[chart])) best[chart] = p;
        std::vector<Pair> tried;
        for (Index p = 0; p < all.size(); ++p)
            if (best[all[p].a] == p && best[all[p].b] == p) tried.push_back(all[p]);
        std::vector<Chart> joined(tried.size());
        parallel_for(
            tried.size(), [&](std::size_t i) { joined[i] = join(tried[i]); }, 1);
        for (std::size_t i = 0; i < tried.size(); ++i) {
            const Pair& p = tried[i];
            if (joined[i].faces.empty()) {
                failed_.insert(key(p));
                continue;
            }
            for (const Index f : charts_[p.b].faces) chart_of_[f] = p.a;
            charts_[p.a] = std::move(joined[i]);
            charts_[p.b] = {};
            number_[p.a] = next_number_++;
        }
        return !tried.empty();
    }

    /// The shared edges of the pair as chains; the longest first.
    std::vector<std::vector<Index>> chains_of(const Pair& p) const {
        std::vector<std::pair<Index, Index>> by_start; // vertex and corner
        std::vector<Index> ends;
        for (std::size_t i = p.begin; i < p.end; ++i) {
            const Index c = shared_[i].corner;
            by_start.emplace_back(surface_.corner_vertex[c], c);
            ends.push_back(surface_.corner_vertex[next_of(c)]);
        }
        std::sort(by_start.begin(), by_start.end());
        std::sort(ends.begin(), ends.end());
        std::vector<std::uint8_t> seen(by_start.size());
        std::vector<std::vector<Index>> chains;
        const auto follow = [&](std::size_t i) {
            chains.emplace_back();
            while (i < by_start.size() && !seen[i]) {
                seen[i] = 1;
                chains.back().push_back(by_start[i].second);
                const Index end = surface_.corner_vertex[next_of(by_start[i].second)];
                i = static_cast<std::size_t>(
                    std::lower_bound(by_start.begin(), by_start.end(), std::pair(end, Index{0})) -
                    by_start.begin());
                if (i < by_start.size() && by_start[i].first != end) break;
            }
        };
        for (std::size_t i = 0; i < by_start.size(); ++i)
            if (!seen[i] && !std::binary_search(ends.begin(), ends.end(), by_start[i].first)) follow(i);
        for (std::size_t i = 0; i < by_start.size(); ++i)
            if (!seen[i]) follow(i);
        const auto size = [&](const std::vector<Index>& chain) {
            double sum = 0;
            for (const Index c : chain) sum += surface_.edge_length(c);
            return sum;
        };
        std::stable_sort(chains.begin(), chains.end(),
                         [&](const auto& x, const auto& y) { return size(x) > size(y); });
        return chains;
    }

    /// The rigid motion that brings the second chart's side of a chain to the first chart's side (least
    /// squares over the ends of its edges).
    Motion motion_along(const std::vector<Index>& chain) const {
        Motion m;
        double all = 0;
        const auto for_each = [&](auto&& use) {
            for (const Index c : chain) {
                const Index t = surface_.twin[c];
                const double w = surface_.edge_length(c);
                use(w, gluing_.at[c], gluing_.at[next_of(t)]);
                use(w, gluing_.at[next_of(c)], gluing_.at[t]);
            }
        };
        for_each([&](double w, const Vec2& a, const Vec2& b) {
            m.to = m.to + a * w;
            m.from = m.from + b * w;
            all += w;
        });
        if (!(all > 0)) return m;
        m.to = m.to * (1 / all);
        m.from = m.from * (1 / all);
        double c = 0, s = 0;
        for_each([&](double w, const Vec2& a, const Vec2& b) {
            c += w * dot(b - m.from, a - m.to);
            s += w * cross(b - m.from, a - m.to);
        });
        const double r = std::sqrt(c * c + s * s);
        if (r > 0) {
            m.c = c / r;
            m.s = s / r;
        }
        return m;
    }

    /// The root of the mean square of the gaps along a chain.
    double gap_along(const std::vector<Index>& chain, const Motion& m) const {
        double sum = 0, all = 0;
        for (const Index c : chain) {
            const Index t = surface_.twin[c];
            const double w = surface_.edge_length(c);
            const Vec2 d = m(gluing_.at[next_of(t)]) - gluing_.at[c],
                       e = m(gluing_.at[t]) - gluing_.at[next_of(c)];
            sum += w * (dot(d, d) + dot(e, e)) / 2;
            all += w;
        }
        return all > 0 ? std::sqrt(sum / all) : HUGE_VAL;
    }

    void glue(const std::vector<Index>& chain, std::uint8_t glued) {
        for (const Index c : chain) gluing_.glued[c] = gluing_.glued[surface_.twin[c]] = glued;
    }

    /// The joined chart, or an empty chart.
    Chart join(const Pair& p) {
        const Chart &a = charts_[p.a], &b = charts_[p.b];
        const double side = std::sqrt(std::min(a.measure.area, b.measure.area));
        const auto chains = chains_of(p);
        const Motion motion = motion_along(chains[0]);
        if (!(gap_along(chains[0], motion) <= widest_gap * side)) return {};
        std::vector<Vec2> before;
        before.reserve(3 * b.faces.size());
        for (const Index f : b.faces)
            for (Index c = 3 * f; c < 3 * f + 3; ++c) {
                before.push_back(gluing_.at[c]);
                gluing_.at[c] = motion(before.back());
            }
        std::vector<std::size_t> used;
        for (std::size_t i = 0; i < chains.size(); ++i)
            if (i == 0 || gap_along(chains[i], {}) <= widest_gap / 4 * side) used.push_back(i);
        for (const std::size_t i : used) glue(chains[i], 1);
        Chart joined = flattened(a, b);
        if (!joined.faces.empty()) return joined;
        for (const std::size_t i : used) glue(chains[i], 0);
        std::size_t i = 0;
        for (const Index f : b.faces)
            for (Index c = 3 * f; c < 3 * f + 3; ++c) gluing_.at[c] = before[i++];
        return {};
    }

    Chart flattened(const Chart& a, const Chart& b) {
        Chart joined;
        joined.faces.resize(a.faces.size() + b.faces.size());
        std::merge(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(), joined.faces.begin());
        FlatChart flat(surface_, gluing_, joined.faces);
        flat.start_from(gluing_);
        flat.relax(rounds_joined);
        joined.measure = flat.measure();
        if (!joined.measure.valid) {
            flat.untangle();
            joined.measure = flat.measure();
        }
        if (!joined.measure.valid || joined.measure.stretch.l2 > max_stretch_ ||
            !packs_well(flat, joined.measure.area))
            return {};
        flat.store(gluing_);
        for (const BorderEdge& e : flat.border())
            joined.perimeter += surface_.edge_length(3 * joined.faces[e.corner / 3] + e.corner % 3);
        return joined;
    }

    /// Whether the chart can be packed well.
    bool packs_well(FlatChart& flat, double area) const {
        std::vector<Vec2> points;
        points.reserve(flat.border().size());
        for (const BorderEdge& e : flat.border()) points.push_back(flat.points()[e.from]);
        const std::vector<Vec2> hull = convex_hull_of(points);
        const double share = area / whole_area_;
        if (area < (share < small_share ? least_solid_small : least_solid) * polygon::signed_area(hull))
            return false;
        const Vec2 u = axis_of_smallest_rectangle(hull);
        Vec2 low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
        for (const Vec2& h : hull) {
            const Vec2 q{dot(u, h), cross(u, h)};
            low = {std::min(low.x, q.x), std::min(low.y, q.y)};
            high = {std::max(high.x, q.x), std::max(high.y, q.y)};
        }
        const Vec2 size = high - low;
        if (size.x > longest_side * std::sqrt(whole_area_)) return false;
        return share < large_share || area >= least_filled * size.x * size.y;
    }

    const UnwrapSurface& surface_;
    const double max_stretch_;
    std::vector<Chart>& charts_; ///< empty where joined
    Gluing& gluing_;
    std::vector<Index> chart_of_; ///< [faces]
    std::vector<Index> number_;   ///< [charts] changes when the chart grows
    double whole_area_ = 0;
    Index next_number_ = 0;
    std::vector<SharedEdge> shared_;
    std::unordered_set<std::uint64_t> failed_; ///< pairs that did not pass; only looked up
};

} // namespace

void join_charts(const UnwrapSurface& surface, double max_stretch, ChartSet& set) {
    Joiner(surface, max_stretch, set).run();
}

} // namespace facetmill::unwrap_room

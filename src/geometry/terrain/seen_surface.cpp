#include "base/math/predicates.hpp"
#include "geometry/polygon/triangulate_rings.hpp"
#include "geometry/terrain/terrain.hpp"
#include "mesh/first_of_equal.hpp"
#include "mesh/position_hash.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill {

namespace {

/// The largest share of the area that a surface may cover twice and still count as covering once. Tiles of a
/// terrain overlap by slivers where a corner of one, after rounding, is not exactly on an edge of another.
constexpr double most_doubled = 1e-6;

/// An edge between two points, and how often it runs from low to high, minus how often it runs back.
struct NetEdge {
    Index low = 0, high = 0;
    std::int32_t count = 0;
};

void add_net_edge(std::vector<NetEdge>& edges, Index from, Index to, int count) {
    if (from < to) edges.push_back({from, to, count});
    if (to < from) edges.push_back({to, from, -count});
}

/// Merges equal edges, and removes edges that cancel.
void cancel_edges(std::vector<NetEdge>& edges) {
    radix_sort(edges, [](const NetEdge& e) { return std::uint64_t{e.low} << 32 | e.high; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edges.size();) {
        NetEdge sum = edges[i];
        for (++i; i < edges.size() && edges[i].low == sum.low && edges[i].high == sum.high; ++i)
            sum.count += edges[i].count;
        if (sum.count != 0) edges[kept++] = sum;
    }
    edges.resize(kept);
}

/// The outline of the triangles in the plane. With `upward`, each is counted as if it looked up, otherwise by
/// the side that it shows. Vertices at the same place count as one, so cracks between them do not matter.
Contours seen_outline(const SeenSurface& s, bool upward) {
    std::vector<NetEdge> edges;
    edges.reserve(s.corners.size());
    for (std::size_t t = 0; t < s.size(); ++t) {
        if (s.turn[t] == 0) continue;
        const int count = upward ? s.turn[t] : 1;
        for (std::size_t k = 0; k < 3; ++k)
            add_net_edge(edges, s.corners[3 * t + k], s.corners[3 * t + (k + 1) % 3], count);
    }
    cancel_edges(edges);
    std::vector<Index> used;
    used.reserve(2 * edges.size());
    for (const NetEdge& e : edges) used.insert(used.end(), {e.low, e.high});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    const auto flat = [&](Index i) { return Vec3{s.points[used[i]].x, s.points[used[i]].y, 0}; };
    const std::vector<Index> first = first_of_equal(
        used.size(), [&](Index i) { return place_hash(flat(i)); },
        [&](Index i, Index j) { return flat(i) == flat(j); });
    const auto number = [&](Index v) {
        return first[static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), v) - used.begin())];
    };
    std::vector<NetEdge> merged;
    merged.reserve(edges.size());
    for (const NetEdge& e : edges) add_net_edge(merged, number(e.low), number(e.high), e.count);
    cancel_edges(merged);
    Contours outline;
    outline.points.reserve(used.size());
    for (Index i = 0; i < used.size(); ++i) outline.points.push_back({flat(i).x, flat(i).y});
    outline.edges.reserve(merged.size());
    for (const NetEdge& e : merged) outline.edges.push_back({e.low, e.high, e.count});
    return outline;
}

/// The areas that an outline winds around.
struct WoundAreas {
    double up = 0, down = 0;             ///< anticlockwise and clockwise
    double twice_up = 0, twice_down = 0; ///< among them, counted for every further turn
    double largest = 0;                  ///< the largest triangle inside two turns
    std::optional<Vec2> at;              ///< its centre

    void add(double area, int winding, const Vec2& centre) {
        if (winding == 0) return;
        const double further = area * (std::abs(winding) - 1);
        (winding > 0 ? up : down) += area;
        (winding > 0 ? twice_up : twice_down) += further;
        if (!(further > largest)) return;
        largest = further;
        at = centre;
    }
    /// The area that does not wind once as the rest does.
    double wrong() const { return up >= down ? down + twice_up : up + twice_down; }
};

WoundAreas areas_in(const Contours& outline) {
    const polygon::Triangulation t = polygon::triangulate_contours(outline);
    const auto point = [&](Index i) {
        return i < outline.points.size() ? outline.points[i] : t.added[i - outline.points.size()].at;
    };
    WoundAreas areas;
    for (std::size_t i = 0; i < t.triangles.size(); ++i) {
        const Vec2 a = point(t.triangles[i][0]), b = point(t.triangles[i][1]), c = point(t.triangles[i][2]);
        areas.add(std::max(0.0, cross(b - a, c - a) / 2), t.winding[i], (a + b + c) * (1.0 / 3));
    }
    return areas;
}

double area_of_seen(const SeenSurface& s) {
    double area = 0;
    for (std::size_t t = 0; t < s.size(); ++t) {
        if (s.turn[t] == 0) continue;
        const Vec3 &a = s.points[s.corners[3 * t]], &b = s.points[s.corners[3 * t + 1]],
                   &c = s.points[s.corners[3 * t + 2]];
        area += std::fabs(cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{c.x - a.x, c.y - a.y})) / 2;
    }
    return area;
}

/// Counts each triangle by the side that it shows. Returns whether this covers the plane once, or as a solid
/// does.
bool covers_by_side(SeenSurface& s) {
    Contours outline = seen_outline(s, false);
    const WoundAreas areas = areas_in(outline);
    const double all = area_of_seen(s);
    if (all > 0 && std::isfinite(all) && areas.up + areas.down <= most_doubled * all) {
        s.sign = s.turn;
        s.cover = Cover::solid;
        return true;
    }
    s.doubled_area = areas.wrong();
    if (s.doubled_area > most_doubled * std::max(areas.up, areas.down)) return false;
    const int up = areas.up >= areas.down ? 1 : -1;
    for (std::size_t t = 0; t < s.size(); ++t) s.sign[t] = static_cast<std::int8_t>(up * s.turn[t]);
    for (auto& e : outline.edges) e.count *= up;
    s.cover = std::count(s.sign.begin(), s.sign.end(), -1) > 0 ? Cover::overhangs : Cover::once;
    s.outline = std::move(outline);
    return true;
}

/// Counts each triangle as if it looked up.
void cover_upward(SeenSurface& s) {
    for (std::size_t t = 0; t < s.size(); ++t) s.sign[t] = s.turn[t] != 0;
    Contours outline = seen_outline(s, true);
    const WoundAreas areas = areas_in(outline);
    s.doubled_area = areas.wrong();
    s.cover = Cover::once;
    if (s.doubled_area > most_doubled * areas.up) {
        s.cover = Cover::several;
        s.doubled = areas.at;
        return;
    }
    s.outline = std::move(outline);
}

} // namespace

TerrainView TerrainView::of(std::size_t axis, const Box& world) {
    TerrainView view{axis, {}};
    if (world.empty()) return view;
    const Vec3 low = view.seen(world.min), high = view.seen(world.max);
    // By Sterbenz' lemma, x - low is exact for low <= x <= 2 low.
    for (std::size_t k = 0; k < 3; ++k)
        view.origin[k] = low[k] > 0 && high[k] <= 2 * low[k]    ? low[k]
                         : high[k] < 0 && low[k] >= 2 * high[k] ? high[k]
                                                                : 0;
    return view;
}

Vec3 TerrainView::world(const Vec3& seen) const {
    const Vec3 p = seen + origin;
    return axis == 0 ? Vec3{p.z, p.x, p.y} : axis == 1 ? Vec3{p.x, p.z, p.y} : p;
}

SeenSurface seen_surface(const Surface& surface, const TerrainView& view) {
    SeenSurface s;
    s.points.resize(surface.positions.size());
    parallel_for(s.points.size(), [&](std::size_t v) { s.points[v] = view.seen(surface.positions[v]); });
    s.corners = surface.corners;
    s.turn.resize(surface.size());
    s.sign.resize(surface.size());
    parallel_for(s.turn.size(), [&](std::size_t t) {
        const Vec3 &a = s.points[s.corners[3 * t]], &b = s.points[s.corners[3 * t + 1]],
                   &c = s.points[s.corners[3 * t + 2]];
        const bool finite = is_finite(a) && is_finite(b) && is_finite(c);
        s.turn[t] = static_cast<std::int8_t>(finite ? orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y) : 0);
    });
    if (!covers_by_side(s)) cover_upward(s);
    return s;
}

} // namespace facetmill

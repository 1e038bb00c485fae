#include "geometry/cut/fill_disjoint.hpp"

#include <algorithm>
#include <utility>

namespace facetmill {

namespace {

/// A directed edge between points, with its count. A negative count means the reverse direction.
struct CountedEdge {
    Index low, high;
    int count;
};

void add_edge(std::vector<CountedEdge>& edges, Index from, Index to, int count) {
    if (from != to) edges.push_back({std::min(from, to), std::max(from, to), from < to ? count : -count});
}

/// Leaves an entry per edge that does not cancel, ascending.
void cancel(std::vector<CountedEdge>& edges) {
    std::sort(edges.begin(), edges.end(), [](const CountedEdge& a, const CountedEdge& b) {
        return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < edges.size();) {
        CountedEdge sum = edges[i++];
        while (i < edges.size() && edges[i].low == sum.low && edges[i].high == sum.high)
            sum.count += edges[i++].count;
        if (sum.count != 0) edges[kept++] = sum;
    }
    edges.resize(kept);
}

/// Returns the part of the boundary that the triangles do not cover. It runs only between coincident points.
std::vector<CountedEdge> left_over(const Contours& contours, const Filling& filling) {
    std::vector<CountedEdge> left;
    for (std::size_t e = 0; e < contours.edges.size(); ++e) {
        const Contours::Edge& edge = contours.edges[e];
        Index last = edge.from;
        for (Index k = filling.path_offsets[e]; k < filling.path_offsets[e + 1]; ++k)
            add_edge(left, std::exchange(last, filling.path[k]), filling.path[k], -edge.count);
        add_edge(left, last, edge.to, -edge.count);
    }
    for (const auto& t : filling.triangles)
        for (std::size_t k = 0; k < 3; ++k) add_edge(left, t[k], t[(k + 1) % 3], 1);
    cancel(left);
    return left;
}

/// Triangulates the polygon of high, low, and the points that represent them; the same triangles for both
/// directions.
void stitch(const CountedEdge& e, Filling& filling) {
    const auto standing_for = [&](Index i) { return i < filling.same.size() ? filling.same[i] : i; };
    std::vector<Index> polygon;
    for (const Index v : {e.high, e.low, standing_for(e.low), standing_for(e.high)})
        if (polygon.empty() || (polygon.back() != v && polygon.front() != v)) polygon.push_back(v);
    for (int times = 0; times < std::abs(e.count); ++times)
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            const Index a = polygon[i - 1], b = polygon[i];
            filling.triangles.push_back({polygon[0], e.count > 0 ? a : b, e.count > 0 ? b : a});
        }
}

} // namespace

Filling fill_disjoint(const Contours& contours) {
    Filling filling = fill(contours);
    bool apart = false;
    for (Index i = 0; i < filling.same.size(); ++i) apart |= filling.same[i] != i;
    if (apart)
        for (const CountedEdge& e : left_over(contours, filling)) stitch(e, filling);
    return filling;
}

} // namespace facetmill

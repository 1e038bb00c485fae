#include "geometry/crop/outline_walls.hpp"

#include "mesh/topology.hpp"

#include <algorithm>

namespace facetmill {

namespace {

polygon::RingTree::Bounds around(const Vec2& p, const Vec2& q, double margin) {
    polygon::RingTree::Bounds box;
    box.add(p);
    box.add(q);
    box.x0 -= margin;
    box.y0 -= margin;
    box.x1 += margin;
    box.y1 += margin;
    return box;
}

} // namespace

Plane upright_plane(std::size_t axis, const Vec2& a, const Vec2& b) {
    const std::size_t u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    Plane plane{{}, {}, 0};
    plane.normal[u] = -(b.y - a.y);
    plane.normal[v] = b.x - a.x;
    plane.through[u] = a.x;
    plane.through[v] = a.y;
    return plane;
}

Walls::Walls(const Footprint& footprint, double rounding) : footprint_(footprint), rounding_(rounding) {
    for (const auto& e : edges()) lengths_.push_back(length(e.b - e.a));
    find_posts();
    stands_.resize(size());
    for (Index w = 0; w < size(); ++w) {
        stands_[w] = {{0, post_[w]}, {lengths_[w], post_[edges()[w].next]}};
        footprint.tree().query(around(edges()[w].a, edges()[w].b, rounding), [&](Index other) {
            const double at = along(w, edges()[other].a);
            const bool within = at > rounding && at < lengths_[w] - rounding;
            if (within && distance(w, edges()[other].a) <= rounding) stands_[w].push_back({at, post_[other]});
            return true;
        });
        std::sort(stands_[w].begin(), stands_[w].end(), [](const Stand& a, const Stand& b) {
            return a.at != b.at ? a.at < b.at : a.post < b.post;
        });
    }
}

void Walls::find_posts() {
    DisjointSets same(size());
    for (Index w = 0; w < size(); ++w) {
        const Vec2 p = edges()[w].a;
        footprint_.tree().query(around(p, p, rounding_), [&](Index other) {
            if (length(edges()[other].a - p) <= rounding_) same.join(w, other);
            return true;
        });
    }
    for (Index w = 0; w < size(); ++w) post_.push_back(same.find(w));
}

double Walls::along(Index wall, const Vec2& p) const {
    const auto& e = edges()[wall];
    return dot(p - e.a, e.b - e.a) / lengths_[wall];
}

double Walls::spread_of_corner(Index wall) const {
    const auto &e = edges()[wall], &f = edges()[e.next];
    const double shorter = std::min(lengths_[wall], lengths_[e.next]),
                 longer = std::max(lengths_[wall], lengths_[e.next]),
                 sine = std::fabs(cross(e.b - e.a, f.b - f.a)) / shorter / longer;
    return std::max(rounding_, std::min(rounding_ / sine, shorter / 1024));
}

const Walls::Stand& Walls::nearest_stand(Index wall, const Vec2& p) const {
    const auto& stands = stands_[wall];
    const auto after = std::lower_bound(stands.begin(), stands.end(), along(wall, p),
                                        [](const Stand& s, double at) { return s.at < at; });
    const auto begin = after - std::min<std::ptrdiff_t>(2, after - stands.begin()),
               end = after + std::min<std::ptrdiff_t>(2, stands.end() - after);
    return *std::min_element(begin, end, [&](const Stand& a, const Stand& b) {
        const double da = length(edges()[a.post].a - p), db = length(edges()[b.post].a - p);
        return da != db ? da < db : a.post < b.post;
    });
}

double Walls::distance(Index wall, const Vec2& p) const {
    const auto& e = edges()[wall];
    const double t = std::clamp(along(wall, p) / lengths_[wall], 0.0, 1.0);
    return length(e.a + (e.b - e.a) * t - p);
}

double Walls::distance(Index wall, const Vec2& p, const Vec2& q) const {
    const auto& e = edges()[wall];
    const auto off_line = [&](const Vec2& r) {
        return std::fabs(cross(e.b - e.a, r - e.a)) / lengths_[wall];
    };
    return off_line(p) + off_line(q) + distance(wall, p + (q - p) * 0.5);
}

Index Walls::nearest(const Vec2& p, const Vec2& q) const {
    const auto middle = p + (q - p) * 0.5;
    for (double margin = rounding_;; margin *= 16) {
        Index best = none;
        double least = HUGE_VAL;
        footprint_.tree().query(around(middle, middle, margin), [&](Index wall) {
            double far = distance(wall, p, q);
            if (far <= 3 * rounding_) far = 0; // nearly identical walls tie, and the first one is chosen
            if (far < least) {
                least = far;
                best = wall;
            }
            return true;
        });
        // Unvisited walls are farther than the margin.
        if (best != none && (least <= margin || !std::isfinite(margin))) return best;
        if (!std::isfinite(margin)) return 0;
    }
}

bool Walls::is_on(Index wall, const Vec2& p, const Vec2& q) const {
    return distance(wall, p + (q - p) * 0.5) <= rounding_ &&
           std::min(distance(wall, p), distance(wall, q)) <= rounding_;
}

} // namespace facetmill

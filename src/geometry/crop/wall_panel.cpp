#include "geometry/crop/wall_panel.hpp"

#include <algorithm>
#include <tuple>

namespace facetmill {

void PostView::stand(Index vertex, Index post) {
    const auto [at, fresh] = post_of.try_emplace(vertex, post);
    if (!fresh) {
        const double old = length(walls.post(at->second) - seen[vertex]),
                     now = length(walls.post(post) - seen[vertex]);
        if (now > old || (now == old && post >= at->second)) return;
        at_post[at->second].erase(vertex);
        at->second = post;
    }
    at_post[post].insert(vertex);
}

double PostView::along(Index wall, Index vertex) const {
    const auto known = post_of.find(vertex);
    const Vec2 p = known == post_of.end() ? seen[vertex] : walls.post(known->second);
    const double at = std::clamp(walls.along(wall, p), 0.0, walls.length_of(wall));
    const auto& stand = walls.nearest_stand(wall, p);
    return std::fabs(at - stand.at) <= walls.rounding() ? stand.at : at;
}

std::vector<Index> PostView::ascending(Index post) const {
    const auto known = at_post.find(post);
    if (known == at_post.end()) return {};
    std::vector<Index> vertices(known->second.begin(), known->second.end());
    std::sort(vertices.begin(), vertices.end(), [&](Index a, Index b) {
        return std::tie(heights[a], seen[a].x, seen[a].y, a) < std::tie(heights[b], seen[b].x, seen[b].y, b);
    });
    return vertices;
}

WallPanel::WallPanel(Index wall, std::span<const WallEdge> edges) : wall_(wall), edges_(edges) {
    for (const WallEdge& e : edges) {
        balance_[e.low] += e.count;
        balance_[e.high] -= e.count;
    }
    std::erase_if(balance_, [](const auto& entry) { return entry.second == 0; });
}

void WallPanel::stand_at_posts(PostView& view) const {
    for (const WallEdge& e : edges_)
        for (const Index v : {e.low, e.high}) {
            const double length = view.walls.length_of(wall_);
            const double at = std::clamp(view.walls.along(wall_, view.seen[v]), 0.0, length);
            const auto& stand = view.walls.nearest_stand(wall_, view.seen[v]);
            if (balance_.contains(v) || std::fabs(at - stand.at) <= view.walls.rounding())
                view.stand(v, stand.post);
        }
}

bool WallPanel::complete(const PostView& view) {
    upright_.clear();
    runs_.clear();
    missed_.clear();
    for (Index i = 0; i < edges_.size(); ++i) {
        Run& run = runs_[{edges_[i].low, edges_[i].high}];
        run.count += edges_[i].count;
        run.own = i;
    }
    balanced_ = true;
    std::set<Index> posts;
    for (const auto& [v, count] : balance_) posts.insert(view.post_of.at(v));
    for (const Index post : posts) add_upright(view, post);
    if (!balanced_) return false;
    make_contours(view);
    filling_ = fill_disjoint(contours_);
    return check_upright();
}

/// A boundary that leaves the wall at a post returns at another height. The upright edges between these
/// heights carry the sum of the balances below them.
void WallPanel::add_upright(const PostView& view, Index post) {
    int carried = 0;
    Index before = none;
    for (const Index v : view.ascending(post)) {
        if (carried != 0) {
            const bool up = before < v;
            const std::pair key{std::min(before, v), std::max(before, v)};
            upright_[key] += up ? carried : -carried;
            Run& run = runs_[key];
            run.count += up ? carried : -carried;
            run.post = post;
        }
        const auto at = balance_.find(v);
        if (at != balance_.end() && view.post_of.at(v) == post) carried -= at->second;
        before = v;
    }
    balanced_ &= carried == 0;
}

/// Orders points and edges by position only, so that the other side of a crop gets the same triangles.
void WallPanel::make_contours(const PostView& view) {
    contours_ = {};
    points_.clear();
    run_of_.clear();
    std::erase_if(runs_, [](const auto& run) { return run.second.count == 0; });
    for (const auto& [ends, run] : runs_) {
        points_.push_back(ends.first);
        points_.push_back(ends.second);
    }
    std::map<Index, Vec2> at;
    for (const Index v : points_) at[v] = {view.along(wall_, v), view.heights[v]};
    std::sort(points_.begin(), points_.end(), [&](Index a, Index b) {
        const Vec2 &p = at[a], &q = at[b], &r = view.seen[a], &s = view.seen[b];
        return std::tie(p.x, p.y, r.x, r.y, a) < std::tie(q.x, q.y, s.x, s.y, b);
    });
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    std::map<Index, Index> local;
    for (const Index v : points_) {
        local[v] = static_cast<Index>(contours_.points.size());
        contours_.points.push_back(at[v]);
    }
    std::map<std::pair<Index, Index>, Run> ordered;
    for (const auto& [ends, run] : runs_) {
        const Index a = local[ends.first], b = local[ends.second];
        Run& turned = ordered[{std::min(a, b), std::max(a, b)}] = run;
        if (b < a) turned.count = -run.count;
    }
    for (const auto& [ends, run] : ordered) { // the wall traverses the boundary backwards
        contours_.edges.push_back({ends.first, ends.second, -run.count});
        run_of_.push_back(run);
    }
}

bool WallPanel::check_upright() {
    for (std::size_t e = 0; e < run_of_.size(); ++e) {
        if (run_of_[e].post == none) continue;
        for (Index k = filling_.path_offsets[e]; k < filling_.path_offsets[e + 1]; ++k) {
            if (filling_.path[k] >= points_.size()) return false;
            missed_.emplace_back(run_of_[e].post, points_[filling_.path[k]]);
        }
    }
    return true;
}

Vec2 WallPanel::place(Index point) const {
    return point < points_.size() ? contours_.points[point] : filling_.added[point - points_.size()].at;
}

double WallPanel::parameter(const Contours::Edge& e, Index point) const {
    const Vec2 a = contours_.points[e.from], d = contours_.points[e.to] - a, p = place(point) - a;
    const double t = std::fabs(d.x) > std::fabs(d.y) ? p.x / d.x : p.y / d.y;
    return std::clamp(t, 0.0, 1.0);
}

std::vector<WallPanel::OnEdge> WallPanel::on_edges() const {
    constexpr double gap = 0x1p-40; // keeps the order of 1 - t too
    std::vector<OnEdge> all;
    for (std::size_t e = 0; e < run_of_.size(); ++e) {
        if (run_of_[e].own == none) continue;
        std::vector<OnEdge> path;
        const Contours::Edge& edge = contours_.edges[e];
        for (Index k = filling_.path_offsets[e]; k < filling_.path_offsets[e + 1]; ++k)
            path.push_back(
                {run_of_[e].own, points_[edge.from], parameter(edge, filling_.path[k]), filling_.path[k]});
        for (std::size_t i = 0; i < path.size(); ++i)
            path[i].t = std::max(path[i].t, i == 0 ? gap : path[i - 1].t + gap);
        for (std::size_t i = path.size(); i-- > 0;)
            path[i].t = std::min(path[i].t, i + 1 == path.size() ? 1 - gap : path[i + 1].t - gap);
        all.insert(all.end(), path.begin(), path.end());
    }
    return all;
}

} // namespace facetmill

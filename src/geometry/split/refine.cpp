// bisect with targets: passes over the edges that are too long, or over the longest as far as a budget goes.
#include "geometry/split/marked.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Marks edges and what follows from them, one after the other, as long as the faces stay within the budget.
class Budget {
  public:
    Budget(const MeasuredEdges& edges, const std::vector<std::uint8_t>& longest, std::uint64_t room)
        : edges_(edges), longest_(longest), room_(room) {}

    /// False, and nothing marked, when it would cost more than there is room for.
    bool add(EdgeMarks& marks, Index e) {
        if (marks[e]) return true;
        trail_.assign(1, e);
        marks[e] = 1;
        std::uint64_t cost = 0;
        for (std::size_t i = 0; i < trail_.size(); ++i) {
            const auto corners = edges_.table.corners_of(trail_[i]);
            cost += corners.size();
            for (const Index c : corners) {
                const Index next = edges_.table.corner_edge[c - c % 3 + longest_[c / 3]];
                if (marks[next]) continue;
                marks[next] = 1;
                trail_.push_back(next);
            }
        }
        if (cost > room_) {
            for (const Index t : trail_) marks[t] = 0;
            return false;
        }
        room_ -= cost;
        return true;
    }

  private:
    const MeasuredEdges& edges_;
    const std::vector<std::uint8_t>& longest_;
    std::uint64_t room_;
    std::vector<Index> trail_;
};

/// The edges longer than the limit (squared), the longest first; of a round with a budget only those longer
/// than half the longest, because what is left of a cut edge is that long at most.
std::vector<Index> candidates(const MeasuredEdges& edges, double limit, bool budget) {
    if (budget) {
        double longest = 0;
        for (const double s : edges.squared) longest = std::max(longest, s);
        limit = std::max(limit, longest / 4);
    }
    std::vector<Index> found;
    for (Index e = 0; e < edges.table.size(); ++e)
        if (edges.squared[e] > limit) found.push_back(e);
    if (budget)
        std::sort(found.begin(), found.end(), [&](Index a, Index b) {
            return edges.squared[a] != edges.squared[b] ? edges.squared[a] > edges.squared[b] : a < b;
        });
    return found;
}

} // namespace

SplitResult refine(const Mesh& mesh, const SplitSettings& settings) {
    using Stop = SplitResult::Stop;
    SplitResult result;
    const double limit = settings.max_edge * settings.max_edge;
    const bool budget = settings.max_faces > 0;
    const std::uint64_t most = budget ? settings.max_faces : UINT64_MAX;
    const Mesh* from = &mesh;
    while (result.stop != Stop::budget) {
        const MeasuredEdges edges = measure_edges(*from, settings.to_world);
        const std::vector<Index> wanted = candidates(edges, limit, budget);
        if (wanted.empty()) {
            result.stop = settings.max_edge > 0 ? Stop::target : Stop::nothing;
            break;
        }
        if (result.passes >= settings.passes) break;
        const auto longest = longest_edges(*from, edges);
        EdgeMarks marks(edges.table.size());
        bool any = false;
        Budget room(edges, longest, most - std::min<std::uint64_t>(most, from->face_count()));
        for (const Index e : wanted) {
            if (!room.add(marks, e)) {
                result.stop = Stop::budget;
                break;
            }
            any = true;
        }
        if (!any) break;
        result.mesh = cut_marked(*from, edges, marks, longest, settings.cut, settings.to_world, result);
        from = &result.mesh;
        ++result.passes;
    }
    if (from == &mesh) result.mesh = mesh;
    result.added = result.mesh.face_count() - mesh.face_count();
    return result;
}

} // namespace facetmill

// The clean step that splits non-manifold edges and vertices.
#include "geometry/clean/steps.hpp"
#include "geometry/inspect/evidence.hpp"

#include <algorithm>
#include <set>

namespace facetmill::clean_steps {

namespace {

/// Failed edges are excluded and the rest is tried again this many times; then all edges that moved faces are
/// excluded.
constexpr int max_divisions = 4;

/// Finds divided edges whose off-edge midpoint causes intersections or faces without area.
class SpoiltEdges {
  public:
    SpoiltEdges(const Work& work, const DividedEdges& divided)
        : before_(work.mesh), divided_(divided), after_(divided.mesh), most_(work.max_box_pairs()) {}

    /// Returns indices into divided.edges.
    std::set<Index> find() {
        std::vector<std::uint8_t> moved(after_.face_count(), 0), had(before_.face_count(), 0);
        for (Index f = 0; f < moved.size(); ++f) {
            if (!is_moved(f)) continue;
            moved[f] = had[divided_.parents[f]] = 1;
            if (is_degenerate(after_, f)) spoil(f);
        }
        const SelfIntersections now = crossings_near(after_, moved, most_);
        if (now.count == 0 && !now.too_many) return std::move(spoilt_);
        const SelfIntersections then = crossings_near(before_, had, most_);
        const bool known = !now.too_many && !then.too_many && now.count == now.pairs.size() &&
                           then.count == then.pairs.size();
        for (Index f = 0; f < moved.size() && !known; ++f) spoil(f);
        for (const auto& [f, g] : now.pairs) {
            const std::pair<Index, Index> parents = std::minmax({divided_.parents[f], divided_.parents[g]});
            if (std::binary_search(then.pairs.begin(), then.pairs.end(), parents)) continue;
            spoil(f);
            spoil(g);
        }
        return std::move(spoilt_);
    }

  private:
    /// The edge whose off-edge point is at the corner, or none.
    Index edge_of(Index corner) const {
        const Index v = after_.vertex(corner);
        if (v < before_.vertex_count()) return none;
        const Index e = divided_.edge_of_point[v - before_.vertex_count()];
        return divided_.edges[e].beside ? e : none;
    }
    bool is_moved(Index f) const {
        for (Index c = after_.face_begin(f); c < after_.face_end(f); ++c)
            if (edge_of(c) != none) return true;
        return false;
    }
    void spoil(Index f) {
        for (Index c = after_.face_begin(f); c < after_.face_end(f); ++c)
            if (const Index e = edge_of(c); e != none) spoilt_.insert(e);
    }

    const Mesh& before_;
    const DividedEdges& divided_;
    const Mesh& after_;
    std::size_t most_;
    std::set<Index> spoilt_;
};

DividedEdges divide_soundly(Work& work, const EdgeTable& edges, EdgeDivision how) {
    for (int tries = 1;; ++tries) {
        DividedEdges divided = divide_crowded_edges(work.mesh, edges, how);
        const auto any_beside = [](const DividedEdges::Edge& e) { return e.beside; };
        if (std::none_of(divided.edges.begin(), divided.edges.end(), any_beside)) return divided;
        const std::set<Index> spoilt = SpoiltEdges(work, divided).find();
        if (spoilt.empty()) return divided;
        for (Index e = 0; e < divided.edges.size(); ++e) {
            const auto& edge = divided.edges[e];
            if (!spoilt.contains(e) && !(tries == max_divisions && edge.beside)) continue;
            how.leave.emplace(edge.low, edge.high);
            work.not_done.push_back({"non_manifold",
                                     "the middle of an edge with more than two faces cannot be rounded onto "
                                     "the edge, so faces would intersect others or lose their area",
                                     edge.point});
        }
    }
}

} // namespace

bool take_apart_non_manifold(Work& work, const EdgeDivision& how, std::optional<EdgeTable>* left) {
    std::size_t parted = 0;
    EdgeTable edges = part_fans(work.mesh, parted);
    DividedEdges divided = divide_soundly(work, edges, how);
    work.counts.split_vertices += parted;
    work.counts.split_edges += divided.edges.size();
    if (divided.edges.empty()) {
        if (left) *left = std::move(edges);
        return parted > 0;
    }
    work.mesh = std::move(divided.mesh);
    work.changes = std::move(divided.changes);
    return true;
}

} // namespace facetmill::clean_steps

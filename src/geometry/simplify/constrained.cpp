// The method constrained: OpenMesh's decimater chooses the collapses. They are replayed into the log, so that
// attributes follow as for the other methods.

#include "geometry/openmesh/decimate.hpp"
#include "geometry/simplify/methods.hpp"

namespace facetmill::simplification {

namespace {

/// The role of each vertex. Only smooth vertices may be removed; pinned and limited vertices are in no
/// collapse.
std::vector<DecimatedVertex> roles_of(const State& s) {
    std::vector<DecimatedVertex> roles(s.vertex_slots(), DecimatedVertex::free);
    for (std::size_t v = 0; v < roles.size(); ++v) {
        if (s.features->kind[v] != Kind::smooth) roles[v] = DecimatedVertex::stays;
        if (s.features->kind[v] == Kind::pinned || (s.bounds.limits && (*s.bounds.limits)[v] < never))
            roles[v] = DecimatedVertex::untouched;
    }
    return roles;
}

/// Follows the faces and wedges of a state through collapses, and logs the collapses.
class Replay {
  public:
    Replay(State& s) : s_(s), last_(s.vertex_slots()) {
        for (std::size_t v = 0; v < last_.size(); ++v)
            for (Index c = s.rings.first[v]; c != none; c = s.rings.next[c]) last_[v] = c;
    }

    void operator()(const Decimation& d) {
        if (s_.has_seams()) hand_over_wedges(d);
        for (Index c = s_.rings.first[d.removed]; c != none; c = s_.rings.next[c]) s_.tri[c] = d.kept;
        s_.rings.next[last_[d.kept]] = s_.rings.first[d.removed];
        last_[d.kept] = last_[d.removed];
        s_.log->steps.push_back({s_.source[d.kept], s_.source[d.removed],
                                 static_cast<Index>(s_.log->wedges.size()), 0, s_.at[d.kept]});
    }

  private:
    Index corner_at(Index face, Index v) const {
        const Index c = 3 * face;
        return s_.tri[c] == v ? c : s_.tri[c + 1] == v ? c + 1 : c + 2;
    }

    void hand_over_wedges(const Decimation& d) {
        const Index to = s_.wedge[corner_at(d.side, d.kept)], from = s_.wedge[corner_at(d.side, d.removed)];
        if (to == from) return;
        s_.log->wedges.push_back({to, from});
        for (Index c = s_.rings.first[d.removed]; c != none; c = s_.rings.next[c]) s_.wedge[c] = to;
    }

    State& s_;
    std::vector<Index> last_; ///< [vertices] the last corner of the list
};

} // namespace

Ended run_constrained(State s, std::size_t vertices, const Goal& goal,
                      const SimplifyConstraints& constraints) {
    const Origin origin(s, vertices);
    SimplifyConstraints scaled = constraints;
    scaled.hausdorff *= s.frame.scale;
    const std::vector<Decimation> collapses =
        decimate(s.at, s.tri, roles_of(s), scaled, {.faces = goal.faces, .vertices = goal.vertices});
    Replay replay(s);
    for (const Decimation& d : collapses) replay(d);
    Ended end;
    end.log = std::move(s.log);
    end.shape = rolled_back(origin, *end.log, end.log->steps.size());
    end.outcome = {.passes = 1, .collapses = collapses.size(), .stuck = !goal.met(end.shape)};
    return end;
}

} // namespace facetmill::simplification

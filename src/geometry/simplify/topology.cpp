// Collapses that change topology, where that is allowed: faces that lie back to back go, holes close,
// components vanish.

#include "geometry/simplify/around.hpp"

#include <utility>

namespace facetmill::simplification {

namespace {

/// Whether a vertex that stays might lose its last face.
bool loses_corner(const Work& s, const Around& r) {
    const auto stays = [&](Index v) { return s.kind[v] >= Kind::corner; };
    for (int i = 0; i < r.sides; ++i)
        if (stays(r.side[static_cast<std::size_t>(i)].opposite)) return true;
    for (int i = 0; i < r.cancellations; ++i) {
        const auto& pair = r.cancelled[static_cast<std::size_t>(i)];
        if (stays(pair.from) || stays(pair.to)) return true;
    }
    return false;
}

/// A vertex without faces loses its list, and is counted once.
class Bare {
  public:
    Bare(Work& s, Index a) : s_(s), a_(a) {}
    std::size_t vertices = 1; ///< that went: the one that was collapsed, and those that were bare

    void look(Index v) {
        if (s_.first[v] == none) {
            if (v == a_) count_a();
            return;
        }
        for (Index c = s_.first[v]; c != none; c = s_.next[c])
            if (s_.live(c / 3)) return;
        s_.first[v] = none;
        if (v == a_)
            count_a();
        else
            ++vertices;
    }

  private:
    void count_a() { vertices += !std::exchange(a_counted_, true); }

    Work& s_;
    Index a_;
    bool a_counted_ = false;
};

/// A vertex of a feature line that is gone moves freely.
void free_if_bare(Work& s, Index v) {
    if (s.kind[v] != Kind::curve) return;
    for (Index c = s.first[v]; c != none; c = s.next[c])
        if (s.live(c / 3) && (s.flags[c] | s.flags[before(c)]) & feature_edge) return;
    s.kind[v] = Kind::smooth;
}

/// The edge from a to x is no boundary when two faces run along it either way.
void unflag_closed(Work& s, Index a, Index x) {
    Index out = none, in = none;
    for (Index c = s.first[a]; c != none; c = s.next[c]) {
        if (!s.live(c / 3)) continue;
        if (s.tri[after(c)] == x) out = c;
        if (s.tri[before(c)] == x) in = before(c);
    }
    if (out == none || in == none || !(s.flags[out] & s.flags[in] & boundary_edge)) return;
    for (const Index c : {out, in}) s.flags[c] &= static_cast<std::uint8_t>(~(boundary_edge | feature_edge));
    for (const Index v : {a, x}) free_if_bare(s, v);
}

} // namespace

bool find_cancelled(const Work& s, Around& r) {
    r.cancellations = 0;
    for (const Spoke& k : r.at_b) {
        if (k.has(r.a)) continue;
        for (const Spoke& other : r.at_a) {
            if (other.next == k.next && other.before == k.before) return false;
            if (other.next != k.before || other.before != k.next) continue;
            if (r.cancellations == Around::most_sides || !s.points.empty()) return false;
            r.cancelled[static_cast<std::size_t>(r.cancellations++)] = {other.corner, k.corner, k.next,
                                                                        k.before};
        }
    }
    return !loses_corner(s, r);
}

bool vanishes(const Work& s, const Around& r) {
    const auto going = static_cast<std::size_t>(r.sides + r.cancellations);
    return s.points.empty() && r.at_a.size == going && r.at_b.size == going;
}

std::pair<std::size_t, std::size_t> settle_topology(Work& s, const Around& r, std::size_t faces) {
    const auto pairs = std::span(r.cancelled).first(static_cast<std::size_t>(r.cancellations));
    const auto sides = std::span(r.side).first(static_cast<std::size_t>(r.sides));
    for (const auto& pair : pairs) kill_face(s, pair.at_a / 3), kill_face(s, pair.at_b / 3);
    Bare bare(s, r.a);
    bare.look(r.a);
    for (const Side& side : sides) bare.look(side.opposite);
    for (const auto& pair : pairs) bare.look(pair.from), bare.look(pair.to);
    for (Index c = s.first[r.a]; c != none; c = s.next[c])
        if (s.live(c / 3)) unflag_closed(s, r.a, s.tri[after(c)]), unflag_closed(s, r.a, s.tri[before(c)]);
    return {faces + 2 * pairs.size(), bare.vertices};
}

} // namespace facetmill::simplification

// One collapse: the tests that keep the guarantees, and the edit.

#include "geometry/closest_point.hpp"
#include "geometry/simplify_work.hpp"

#include <utility>

namespace facetmill::simplification {

namespace {

constexpr double least_cosine = 0.5; // no face turns by more than 60 degrees
// A face whose height is below this share of its longest edge counts as flat: far above what rounding can do,
// far below what anyone wants.
constexpr double least_height = 1e-5;
// A face as near to a point as this share of the bound (squared) is not compared with others.
constexpr double near_enough = 0.01;
// Where on a face that stays, by the weights of its other two vertices, it is asked how far the surface is.
constexpr std::pair<double, double> places_on_face[]{
    {1.0 / 3, 1.0 / 3}, {0.5, 0}, {0.5, 0.5}, {1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};
constexpr int most_sides =
    4; // faces on an edge that goes; more than two only where topology was allowed to go

/// The live corners at a vertex; false when there are too many.
bool gather(const Work& s, Index v, std::array<Index, Rings::most>& ring, int& size) {
    size = 0;
    for (Index c = s.first[v]; c != none; c = s.next[c]) {
        if (!s.live(c / 3)) continue;
        if (size == Rings::most) return false;
        ring[static_cast<std::size_t>(size++)] = c;
    }
    return true;
}

/// A face on the edge: its corners at the two ends, and the vertex across.
struct Side {
    Index at_a, at_b, opposite;
};

/// An edge about to go: b into a.
class Collapse {
  public:
    Collapse(Work& s, Index a, Index b, Rings& rings) : s_(s), a_(a), b_(b), r_(rings) {}

    /// 0, or why the collapse to `to` is not allowed.
    /// most: how far points may be, squared.
    std::uint8_t refusal(const Vec3& to, bool a_stays, bool along, bool boundary, double most,
                         std::uint32_t stamp) {
        if (!gather(s_, a_, r_.a, r_.a_size) || !gather(s_, b_, r_.b, r_.b_size)) return blocked_topology;
        find_sides();
        if (!(s_.allow ? sides_ >= 1 && sides_ <= most_sides : sides_ == (boundary ? 1 : 2)))
            return blocked_topology;
        if (!link_condition(along, stamp)) return blocked_topology;
        if (!s_.wedge.empty() && !pair_wedges(a_stays)) return blocked_border;
        if (changes_topology_ && (!find_cancelled() || loses_corner())) return blocked_topology;
        if (changes_topology_ && vanishes()) return 0;
        if (!a_stays && !keeps_facing(a_, r_.a, r_.a_size, b_, to)) return blocked_flip;
        if (!keeps_facing(b_, r_.b, r_.b_size, a_, to)) return blocked_flip;
        return s_.points.empty() || (keeps_points(to, most) && is_near(to, most)) ? 0 : blocked_error;
    }

    /// Makes it. Returns the faces and vertices that went.
    std::pair<std::size_t, std::size_t> make(const Vec3& to, double error, Log& log) {
        if (!s_.points.empty()) hand_over_points();
        if (!s_.wedge.empty()) hand_over_wedges(log);
        if (s_.logging)
            log.steps.push_back({s_.source[a_], s_.source[b_], static_cast<Index>(log.wedges.size()),
                                 static_cast<float>(error), to});
        join_lists();
        for (int i = 0; i < sides_; ++i) {
            const Index f = side_[i].at_a / 3;
            if (s_.has_features) pass_on_features(side_[i]);
            s_.tri[3 * f] = none;
        }
        const auto faces = static_cast<std::size_t>(sides_);
        return changes_topology_ ? settle_topology(faces) : std::pair{faces, std::size_t{1}};
    }

  private:
    std::span<const Index> ring_a() const { return {r_.a.data(), static_cast<std::size_t>(r_.a_size)}; }
    std::span<const Index> ring_b() const { return {r_.b.data(), static_cast<std::size_t>(r_.b_size)}; }

    void find_sides() {
        sides_ = 0;
        for (const Index c : ring_a()) {
            const Index n = after(c), p = before(c);
            const bool leads = s_.tri[n] == b_;
            if (!leads && s_.tri[p] != b_) continue;
            if (sides_ < most_sides) side_[sides_] = leads ? Side{c, n, s_.tri[p]} : Side{c, p, s_.tri[n]};
            ++sides_;
        }
    }

    /// The ends' links meet in nothing but the opposite vertices (Dey et al. 1999; the outside of a boundary,
    /// and both sides of a feature line, count as one more vertex).
    bool link_condition(bool along, std::uint32_t stamp) {
        for (const Index c : ring_a()) s_.mark[s_.tri[after(c)]] = s_.mark[s_.tri[before(c)]] = stamp;
        int common = 0;
        for (const Index c : ring_b())
            for (const Index v : {s_.tri[after(c)], s_.tri[before(c)]})
                if (v != a_ && s_.mark[v] == stamp) s_.mark[v] = stamp + 1, ++common;
        changes_topology_ = common != sides_ || sides_ > 2 ||
                            (sides_ == 2 && joined(ring_a()) && joined(ring_b())); // the last tetrahedron
        if (along)
            for (int i = 0; i < sides_; ++i) { // a loop of three feature edges would close on itself
                const auto both = edge_flags(side_[i].at_a, side_[i].opposite) &
                                  edge_flags(side_[i].at_b, side_[i].opposite);
                if (!(both & feature_edge)) continue;
                changes_topology_ = true;
                if (!(both & boundary_edge)) return false; // of a seam or border, not a lone triangle
            }
        return s_.allow || !changes_topology_;
    }

    /// Finds the faces that would lie back to back, which go both; false when some would be doubled, or when
    /// the points on them would have nowhere to go.
    bool find_cancelled() {
        cancelled_ = 0;
        for (const Index c : ring_b()) {
            const Index n = s_.tri[after(c)], p = s_.tri[before(c)];
            if (n == a_ || p == a_) continue;
            for (const Index d : ring_a()) {
                if (s_.tri[after(d)] == n && s_.tri[before(d)] == p) return false;
                if (s_.tri[after(d)] != p || s_.tri[before(d)] != n) continue;
                if (cancelled_ == most_sides || !s_.points.empty()) return false;
                cancel_[cancelled_][0] = c, cancel_[cancelled_][1] = d;
                cancel_ends_[cancelled_][0] = n, cancel_ends_[cancelled_][1] = p, ++cancelled_;
            }
        }
        return true;
    }

    /// Whether a vertex that stays might lose its last face.
    bool loses_corner() const {
        const auto stays = [&](Index v) { return s_.kind[v] >= Kind::corner; };
        for (int i = 0; i < sides_; ++i)
            if (stays(side_[i].opposite)) return true;
        for (int i = 0; i < cancelled_; ++i)
            if (stays(cancel_ends_[i][0]) || stays(cancel_ends_[i][1])) return true;
        return false;
    }

    /// Whether no face at either end would be left.
    bool vanishes() const {
        return s_.points.empty() && r_.a_size == sides_ + cancelled_ && r_.b_size == sides_ + cancelled_;
    }

    /// After the edit: takes away the faces that lie back to back, tells closed holes and vertices that have
    /// no face any more. Returns all faces and vertices that went.
    std::pair<std::size_t, std::size_t> settle_topology(std::size_t faces) {
        for (int i = 0; i < cancelled_; ++i)
            for (const Index c : cancel_[i]) s_.tri[3 * (c / 3)] = none;
        faces += 2 * static_cast<std::size_t>(cancelled_);
        std::size_t vertices = 1 + drop_bare(a_);
        for (int i = 0; i < sides_; ++i) vertices += drop_bare(side_[i].opposite);
        for (int i = 0; i < cancelled_; ++i)
            for (const Index v : cancel_ends_[i]) vertices += drop_bare(v);
        for (Index c = s_.first[a_]; c != none; c = s_.next[c])
            if (s_.live(c / 3)) unflag_closed(s_.tri[after(c)]), unflag_closed(s_.tri[before(c)]);
        return {faces, vertices};
    }

    /// A vertex without faces loses its list. Returns how many there were: 1, or 0.
    std::size_t drop_bare(Index v) {
        if (s_.first[v] == none) return v == a_ && !std::exchange(a_counted_, true);
        for (Index c = s_.first[v]; c != none; c = s_.next[c])
            if (s_.live(c / 3)) return 0;
        s_.first[v] = none;
        if (v == a_) a_counted_ = true;
        return 1;
    }

    /// The edge from a to x is no boundary when two faces run along it either way.
    void unflag_closed(Index x) {
        Index out = none, in = none;
        for (Index c = s_.first[a_]; c != none; c = s_.next[c]) {
            if (!s_.live(c / 3)) continue;
            if (s_.tri[after(c)] == x) out = c;
            if (s_.tri[before(c)] == x) in = before(c);
        }
        if (out == none || in == none || !(s_.flags[out] & s_.flags[in] & boundary_edge)) return;
        for (const Index c : {out, in})
            s_.flags[c] &= static_cast<std::uint8_t>(~(boundary_edge | feature_edge));
        for (const Index v : {a_, x}) freed_if_bare(v);
    }

    /// A vertex of a feature line that is gone moves freely.
    void freed_if_bare(Index v) {
        if (s_.kind[v] != Kind::curve) return;
        for (Index c = s_.first[v]; c != none; c = s_.next[c])
            if (s_.live(c / 3) && (s_.flags[c] | s_.flags[before(c)]) & feature_edge) return;
        s_.kind[v] = Kind::smooth;
    }

    /// Whether a face of the ring has both opposite vertices.
    bool joined(std::span<const Index> ring) const {
        const Index x = side_[0].opposite, y = side_[1].opposite;
        for (const Index c : ring) {
            const Index n = s_.tri[after(c)], p = s_.tri[before(c)];
            if ((n == x && p == y) || (n == y && p == x)) return true;
        }
        return false;
    }

    /// Flags of the edge of c's face between c's vertex and v.
    std::uint8_t edge_flags(Index c, Index v) const {
        return s_.flags[s_.tri[after(c)] == v ? c : before(c)];
    }

    /// Finds for each wedge at b the one at a that takes its faces.
    bool pair_wedges(bool a_stays) {
        pairs_ = 0;
        for (int i = 0; i < sides_; ++i) {
            const Index to = s_.wedge[side_[i].at_a], from = s_.wedge[side_[i].at_b];
            const Index known = taker(from);
            if (known != none) {
                if (to != known) return false;
                continue;
            }
            // Two wedges may end in one only when that one keeps its own attributes.
            if (!a_stays)
                for (int k = 0; k < pairs_; ++k)
                    if (pair_[k][0] == to) return false;
            if (s_.sides)
                for (int k = 0; k < pairs_; ++k)
                    if (pair_[k][0] == to && (*s_.sides)[pair_[k][1]] != (*s_.sides)[from]) return false;
            pair_[pairs_][0] = to, pair_[pairs_][1] = from;
            ++pairs_;
        }
        for (const Index c : ring_b())
            if (taker(s_.wedge[c]) == none) return false;
        return true;
    }

    Index taker(Index wedge) const {
        for (int i = 0; i < pairs_; ++i)
            if (pair_[i][1] == wedge) return pair_[i][0];
        return none;
    }

    /// Whether the faces of the ring that stay keep their side when v moves.
    bool keeps_facing(Index v, const std::array<Index, Rings::most>& ring, int size, Index other,
                      const Vec3& to) const {
        const Vec3& from = s_.at[v];
        for (int i = 0; i < size; ++i) {
            const Index n = s_.tri[after(ring[static_cast<std::size_t>(i)])];
            const Index p = s_.tri[before(ring[static_cast<std::size_t>(i)])];
            if (n == other || p == other) continue;
            const Vec3 &x = s_.at[n], &y = s_.at[p];
            const Vec3 old = cross(x - from, y - from), now = cross(x - to, y - to);
            const double was = dot(old, old), is = dot(now, now), turn = dot(old, now);
            if (!(was > 0)) continue; // degenerate before: nothing to keep
            if (!(turn > 0 && turn * turn >= least_cosine * least_cosine * was * is)) return false;
            const double longest = std::max({dot(x - to, x - to), dot(y - to, y - to), dot(x - y, x - y)});
            const double least = least_height * longest;
            if (is < least * least && is < was) return false;
        }
        return true;
    }

    /// Calls body(corner at a or b) for the faces around the edge, or for those of them that stay.
    template <class Body>
    void for_faces(bool staying, Body&& body) const {
        const auto has = [&](Index c, Index v) { return s_.tri[after(c)] == v || s_.tri[before(c)] == v; };
        for (const Index c : ring_a())
            if (!staying || !has(c, b_)) body(c);
        for (const Index c : ring_b())
            if (!has(c, a_)) body(c);
    }

    /// Finds the face that takes each point of the faces around; false when one would be too far from all.
    bool keeps_points(const Vec3& to, double most) {
        r_.points.clear(), r_.taken_by.clear(), r_.staying.clear();
        for_faces(true, [&](Index c) { r_.staying.push_back(c); });
        for_faces(false, [&](Index c) {
            for (Index p = s_.first_point[c / 3]; p != none; p = s_.next_point[p]) r_.points.push_back(p);
        });
        for (const Index p : r_.points) {
            double least = HUGE_VAL;
            Index taker = none;
            for (Index i = 0; i < r_.staying.size() && least > near_enough * most; ++i) {
                const Index c = r_.staying[i];
                const Vec3 off = s_.points[p] - closest_on_triangle(s_.points[p], to, s_.at[s_.tri[after(c)]],
                                                                    s_.at[s_.tri[before(c)]]);
                if (dot(off, off) < least) least = dot(off, off), taker = i;
            }
            if (!(least <= most)) return false;
            r_.taken_by.push_back(taker);
        }
        return true;
    }

    /// Whether the new vertex and places on the faces at it are near the surface that came in: near a point
    /// of it that the face took, or else near any place.
    bool is_near(const Vec3& to, double most) {
        r_.places.assign(1, to);
        for (const Index c : r_.staying) {
            const Vec3 &x = s_.at[s_.tri[after(c)]], &y = s_.at[s_.tri[before(c)]];
            for (const auto& [a, b] : places_on_face) r_.places.push_back(to * (1 - a - b) + x * a + y * b);
        }
        r_.near.assign(r_.places.size(), 0);
        const auto look = [&](std::size_t place, const Vec3& p) {
            const Vec3 off = r_.places[place] - p;
            if (dot(off, off) <= most) r_.near[place] = 1;
        };
        for (std::size_t i = 0; i < r_.points.size(); ++i) {
            const Vec3& p = s_.points[r_.points[i]];
            look(0, p);
            for (std::size_t k = 0; k < std::size(places_on_face); ++k)
                look(1 + std::size(places_on_face) * r_.taken_by[i] + k, p);
        }
        const double bound = std::sqrt(most) / s_.scale;
        Index hint = none;
        for (std::size_t i = 0; i < r_.places.size(); ++i) {
            if (r_.near[i]) continue;
            const Closest found = closest_point(*s_.given, r_.places[i] / s_.scale + s_.centre, hint, bound);
            if (!(found.distance <= bound)) return false;
            hint = found.triangle;
        }
        return true;
    }

    void hand_over_points() {
        for_faces(false, [&](Index c) { s_.first_point[c / 3] = none; });
        for (std::size_t i = 0; i < r_.points.size(); ++i)
            s_.next_point[r_.points[i]] =
                std::exchange(s_.first_point[r_.staying[r_.taken_by[i]] / 3], r_.points[i]);
    }

    void hand_over_wedges(Log& log) {
        for (int i = 0; i < pairs_; ++i)
            if (pair_[i][0] != pair_[i][1]) {
                if (s_.logging) log.wedges.push_back({pair_[i][0], pair_[i][1]});
                join_fields(s_.fields, pair_[i][0], pair_[i][1]);
            }
        for (const Index c : ring_b()) s_.wedge[c] = taker(s_.wedge[c]);
    }

    /// a's list becomes the corners that stay, b's becomes empty.
    void join_lists() {
        Index* link = &s_.first[a_];
        const auto add = [&](Index c, Index other) {
            if (s_.tri[after(c)] == other || s_.tri[before(c)] == other) return;
            *link = c;
            link = &s_.next[c];
        };
        for (const Index c : ring_a()) add(c, b_);
        for (const Index c : ring_b()) add(c, a_);
        *link = none;
        for (const Index c : ring_b())
            if (s_.tri[after(c)] != a_ && s_.tri[before(c)] != a_) s_.tri[c] = a_;
        s_.first[b_] = none;
    }

    /// The edges from a and b to the opposite vertex become one: a feature if either was.
    void pass_on_features(const Side& side) {
        const auto either = static_cast<std::uint8_t>(
            (edge_flags(side.at_a, side.opposite) | edge_flags(side.at_b, side.opposite)) &
            (boundary_edge | feature_edge));
        if (!either) return;
        for (Index c = s_.first[a_]; c != none; c = s_.next[c]) {
            if (s_.tri[after(c)] == side.opposite) s_.flags[c] |= either;
            if (s_.tri[before(c)] == side.opposite) s_.flags[before(c)] |= either;
        }
    }

    Work& s_;
    Index a_, b_;
    Rings& r_;
    Side side_[most_sides] = {};
    int sides_ = 0;
    Index pair_[most_sides][2] = {}; // wedge at a, wedge at b
    int pairs_ = 0;
    // Only where topology may change.
    bool changes_topology_ = false, a_counted_ = false;
    Index cancel_[most_sides][2] = {}, cancel_ends_[most_sides][2] = {}; // faces back to back, by a corner
    int cancelled_ = 0;
};

} // namespace

bool collapse(Work& s, Index c, double most, std::uint32_t stamp, Rings& rings, Tally& tally) {
    const Index u = s.tri[c], v = s.tri[after(c)];
    const std::uint8_t flags = s.flags[c];
    const Placement p = place(s, c, flags);
    const Index a = p.keep_second ? v : u, b = p.keep_second ? u : v;
    const bool stays = p.keep_first || p.keep_second;
    Collapse edit(s, a, b, rings);
    const bool beyond = !s.limit.empty() && !(p.error < std::min(s.limit[a], s.limit[b]));
    const auto why =
        beyond ? blocked_border
               : edit.refusal(p.at, stays, flags & feature_edge, flags & boundary_edge, most, stamp);
    if (why) {
        s.flags[c] |= why;
        s.cost[c] = never;
        ++tally.refused;
        return false;
    }
    s.kind[a] = std::max(s.kind[a], s.kind[b]);
    if (!s.limit.empty()) s.limit[a] = std::min(s.limit[a], s.limit[b]);
    const auto [faces, vertices] = edit.make(p.at, p.error, tally.log);
    s.at[a] = p.at;
    s.moved[a] |= !stays;
    s.touched[a] = s.touched[b] = s.pass;
    for (Index n = s.first[a]; n != none; n = s.next[n])
        if (s.live(n / 3)) s.stirred[s.tri[after(n)]] = s.stirred[s.tri[before(n)]] = s.pass;
    if (!s.quadrics.empty()) s.quadrics[a] += s.quadrics[b];
    if (s.wedge.empty()) join_fields(s.fields, a, b);
    tally.largest = std::max(tally.largest, p.error);
    ++tally.collapses;
    tally.faces += faces, tally.vertices += vertices;
    return true;
}

} // namespace facetmill::simplification

#include "geometry/simplify/collapse.hpp"

#include "geometry/simplify/attributes.hpp"
#include "geometry/simplify/methods.hpp"

#include <span>
#include <utility>

namespace facetmill::simplification {

namespace {

constexpr double least_cosine = 0.5; // no face turns by more than 60 degrees
constexpr std::uint8_t outside = 64,
                       later = 128; // outside the territory, or postponed: these reasons are not stored

/// Collects the live faces at a vertex; false when there are too many.
bool gather(const State& s, Index v, Ring& ring) {
    std::size_t size = 0;
    for (Index c = s.rings.first[v]; c != none; c = s.rings.next[c]) {
        const Index* t = &s.tri[c - c % 3];
        if (t[0] == none) continue;
        if (size == Ring::max_size) return false;
        ring.corners[size++] = {c, s.tri[after(c)], s.tri[before(c)]};
    }
    ring.size = size;
    return true;
}

/// A set of vertices with a fast negative answer for most lookups.
class Vertices {
  public:
    explicit Vertices(const Ring& ring) : ring_(ring) {
        for (const RingCorner& k : ring) hints_ |= hint(k.next) | hint(k.before);
    }
    bool has(Index v) const {
        if (!(hints_ & hint(v))) return false;
        return std::any_of(ring_.begin(), ring_.end(), [&](const RingCorner& k) { return k.has(v); });
    }

  private:
    static std::uint64_t hint(Index v) { return std::uint64_t{1} << (v % 64); }
    const Ring& ring_;
    std::uint64_t hints_ = 0;
};

// Topology changes: back-to-back faces are removed, holes close, components vanish.

/// Removes a face and the costs of its edges.
void kill_face(State& s, Index f) {
    s.tri[3 * f] = none;
    for (Index c = 3 * f; c < 3 * f + 3; ++c) s.edges.cost[c] = never;
}

/// True if a vertex that must stay would lose its last face.
bool loses_corner(const State& s, const Around& r) {
    const auto stays = [&](Index v) { return s.features->kind[v] >= Kind::corner; };
    for (int i = 0; i < r.sides; ++i)
        if (stays(r.side[static_cast<std::size_t>(i)].opposite)) return true;
    for (int i = 0; i < r.cancellations; ++i) {
        const auto& pair = r.cancelled[static_cast<std::size_t>(i)];
        if (stays(pair.from) || stays(pair.to)) return true;
    }
    return false;
}

/// Clears the lists of vertices that lost all faces, and counts each once.
class Bare {
  public:
    Bare(State& s, Index a) : s_(s), a_(a) {}
    std::size_t vertices = 1; ///< removed: the collapsed vertex, and vertices without faces

    void look(Index v) {
        if (s_.rings.first[v] == none) {
            if (v == a_) count_a();
            return;
        }
        for (Index c = s_.rings.first[v]; c != none; c = s_.rings.next[c])
            if (s_.live(c / 3)) return;
        s_.rings.first[v] = none;
        if (v == a_)
            count_a();
        else
            ++vertices;
    }

  private:
    void count_a() { vertices += !std::exchange(a_counted_, true); }

    State& s_;
    Index a_;
    bool a_counted_ = false;
};

/// A vertex moves freely once its feature line is gone.
void free_if_bare(State& s, Index v) {
    if (s.features->kind[v] != Kind::curve) return;
    for (Index c = s.rings.first[v]; c != none; c = s.rings.next[c])
        if (s.live(c / 3) && (s.edges.flags[c] | s.edges.flags[before(c)]) & feature_edge) return;
    s.features->kind[v] = Kind::smooth;
}

/// Clears the boundary flag of the edge from a to x if faces run along it in both directions.
void unflag_closed(State& s, Index a, Index x) {
    Index out = none, in = none;
    for (Index c = s.rings.first[a]; c != none; c = s.rings.next[c]) {
        if (!s.live(c / 3)) continue;
        if (s.tri[after(c)] == x) out = c;
        if (s.tri[before(c)] == x) in = before(c);
    }
    if (out == none || in == none || !(s.edges.flags[out] & s.edges.flags[in] & boundary_edge)) return;
    for (const Index c : {out, in})
        s.edges.flags[c] &= static_cast<std::uint8_t>(~(boundary_edge | feature_edge));
    for (const Index v : {a, x}) free_if_bare(s, v);
}

/// Finds pairs of faces that would lie back to back, to remove both. Returns false if the collapse would
/// double a face, remove a corner's last face, or leave points without a face.
bool find_cancelled(const State& s, Around& r) {
    r.cancellations = 0;
    for (const RingCorner& k : r.at_b) {
        if (k.has(r.a)) continue;
        for (const RingCorner& other : r.at_a) {
            if (other.next == k.next && other.before == k.before) return false;
            if (other.next != k.before || other.before != k.next) continue;
            if (r.cancellations == Around::max_sides || s.bounds.followed) return false;
            r.cancelled[static_cast<std::size_t>(r.cancellations++)] = {other.corner, k.corner, k.next,
                                                                        k.before};
        }
    }
    return !loses_corner(s, r);
}

/// True if neither end would have a face left.
bool vanishes(const State& s, const Around& r) {
    const auto going = static_cast<std::size_t>(r.sides + r.cancellations);
    return !s.bounds.followed && r.at_a.size == going && r.at_b.size == going;
}

/// Updates the topology after the collapse: removes back-to-back faces, updates closed holes, and handles
/// vertices without faces. faces: removed before. Returns the total numbers of removed faces and vertices.
std::pair<std::size_t, std::size_t> settle_topology(State& s, const Around& r, std::size_t faces) {
    const auto pairs = std::span(r.cancelled).first(static_cast<std::size_t>(r.cancellations));
    const auto sides = std::span(r.side).first(static_cast<std::size_t>(r.sides));
    for (const auto& pair : pairs) {
        kill_face(s, pair.at_a / 3);
        kill_face(s, pair.at_b / 3);
    }
    Bare bare(s, r.a);
    bare.look(r.a);
    for (const Side& side : sides) bare.look(side.opposite);
    for (const auto& pair : pairs) {
        bare.look(pair.from);
        bare.look(pair.to);
    }
    for (Index c = s.rings.first[r.a]; c != none; c = s.rings.next[c])
        if (s.live(c / 3)) {
            unflag_closed(s, r.a, s.tri[after(c)]);
            unflag_closed(s, r.a, s.tri[before(c)]);
        }
    return {faces + 2 * pairs.size(), bare.vertices};
}

/// Twice the area below which a triangle counts as flat.
double least_area(const Vec3& x, const Vec3& y, const Vec3& z) {
    return least_height * std::max({dot(x - z, x - z), dot(y - z, y - z), dot(y - x, y - x)});
}

/// True if the angle between two normals is small enough.
bool is_near(const Vec3& old, const Vec3& now) {
    const double turn = dot(old, now);
    return turn > 0 && turn * turn >= least_cosine * least_cosine * dot(old, old) * dot(now, now);
}

/// An edge to collapse: r.b merges into r.a.
class Collapse {
  public:
    Collapse(State& s, Around& r) : s_(s), r_(r) {}

    /// 0, or the reason why the collapse to `to` is not allowed.
    std::uint8_t refusal(const Vec3& to, bool a_stays, bool along, bool boundary) {
        if (!gather(s_, r_.a, r_.at_a) || !gather(s_, r_.b, r_.at_b)) return blocked_topology;
        if (!is_inside()) return outside;
        find_sides();
        if (!(s_.rules.changes_topology ? r_.sides >= 1 && r_.sides <= Around::max_sides
                                        : r_.sides == (boundary ? 1 : 2)))
            return blocked_topology;
        if (!link_condition(along)) return blocked_topology;
        if (s_.rules.apart && a_stays && joins_held()) return blocked_border;
        if (s_.has_seams() && !pair_wedges(a_stays)) return blocked_border;
        if (r_.changes_topology && !find_cancelled(s_, r_)) return blocked_topology;
        if (r_.changes_topology && r_.waits) return later;
        if (r_.changes_topology && vanishes(s_, r_)) return 0;
        if (!a_stays && !keeps_facing(r_.a, r_.at_a, r_.b, to)) return blocked_flip;
        if (!keeps_facing(r_.b, r_.at_b, r_.a, to)) return blocked_flip;
        return !s_.bounds.followed || points_stay_near(s_, r_, to) ? 0 : blocked_error;
    }

    /// Performs the collapse. Returns the numbers of removed faces and vertices.
    std::pair<std::size_t, std::size_t> make(const Vec3& to, double error, Collapses& log) {
        if (s_.bounds.followed) hand_over_points(s_, r_);
        if (s_.has_seams()) hand_over_wedges(log);
        if (s_.log)
            log.steps.push_back({s_.source[r_.a], s_.source[r_.b], static_cast<Index>(log.wedges.size()),
                                 static_cast<float>(error), to});
        join_lists();
        for (const Side& side : sides()) {
            if (s_.features->any) pass_on_features(side);
            kill_face(s_, side.at_a / 3);
        }
        const auto faces = static_cast<std::size_t>(r_.sides);
        return r_.changes_topology ? settle_topology(s_, r_, faces) : std::pair{faces, std::size_t{1}};
    }

    /// Updates the costs of the edges at a, which now include b's, and marks the vertices around as dirty.
    void price(Pricer& pricer) {
        if (r_.changes_topology) { // more faces were removed than the faces on the edge
            if (!gather(s_, r_.a, r_.at_a)) return;
            r_.at_b.size = 0;
        }
        const auto price_ring = [&](const Ring& ring, Index gone) {
            for (const RingCorner& k : ring) {
                if (k.has(gone)) continue;
                s_.order.dirty[k.next] = s_.order.dirty[k.before] = s_.order.pass;
                pricer(k.corner, r_.a, k.next);
                pricer(simplification::before(k.corner), k.before, r_.a);
            }
        };
        price_ring(r_.at_a, r_.b);
        price_ring(r_.at_b, r_.a);
        pricer.finish();
    }

  private:
    std::span<const Side> sides() const {
        return std::span(r_.side).first(static_cast<std::size_t>(r_.sides));
    }

    bool is_inside() const {
        const Territory& mine = r_.territory;
        const auto inside = [&](const RingCorner& k) { return mine.has(k.next) && mine.has(k.before); };
        return std::all_of(r_.at_a.begin(), r_.at_a.end(), inside) &&
               std::all_of(r_.at_b.begin(), r_.at_b.end(), inside);
    }

    void find_sides() {
        r_.sides = 0;
        for (const RingCorner& k : r_.at_a) {
            if (!k.has(r_.b)) continue;
            if (r_.sides < Around::max_sides)
                r_.side[static_cast<std::size_t>(r_.sides)] = k.next == r_.b
                                                                  ? Side{k.corner, after(k.corner), k.before}
                                                                  : Side{k.corner, before(k.corner), k.next};
            ++r_.sides;
        }
    }

    /// The number of common neighbours of both ends; at most 8.
    int common_neighbours() const {
        const Vertices near_a(r_.at_a);
        std::array<Index, 8> seen;
        std::size_t count = 0;
        for (const RingCorner& k : r_.at_b)
            for (const Index v : {k.next, k.before}) {
                if (v == r_.a || !near_a.has(v)) continue;
                const auto end = seen.begin() + static_cast<std::ptrdiff_t>(count);
                if (std::find(seen.begin(), end, v) != end) continue;
                seen[count++] = v;
                if (count == seen.size()) return static_cast<int>(count);
            }
        return static_cast<int>(count);
    }

    /// True if the links of the ends meet only in the opposite vertices (T. Dey, H. Edelsbrunner, S. Guha
    /// and D. Nekhayev, 'Topology preserving edge contraction', 1999). The outside of a boundary, and both
    /// sides of a feature line, count as an additional vertex.
    bool link_condition(bool along) {
        r_.changes_topology = common_neighbours() != r_.sides || r_.sides > 2 ||
                              (r_.sides == 2 && joined(r_.at_a) && joined(r_.at_b)); // the last tetrahedron
        if (along)
            for (const Side& side : sides()) { // a loop of three feature edges would close on itself
                const auto both = edge_flags(side.at_a, side.opposite) & edge_flags(side.at_b, side.opposite);
                if (!(both & feature_edge)) continue;
                r_.changes_topology = true;
                if (!(both & boundary_edge)) return false; // part of a seam or border, not a lone triangle
            }
        return s_.rules.changes_topology || (!r_.changes_topology && keeps_non_manifold_edges());
    }

    /// True if a vertex marked in `apart` would get a new edge to another marked vertex.
    bool joins_held() const {
        const auto held = [this](Index v) { return (*s_.rules.apart)[s_.source[v]] != 0; };
        if (!held(r_.a)) return false;
        const Vertices near_a(r_.at_a);
        return std::any_of(r_.at_b.begin(), r_.at_b.end(), [&](const RingCorner& k) {
            return (k.next != r_.a && held(k.next) && !near_a.has(k.next)) ||
                   (k.before != r_.a && held(k.before) && !near_a.has(k.before));
        });
    }

    /// The two edges to an opposite vertex merge into an edge with the remaining faces of both. An edge with
    /// more than two faces must keep this number.
    bool keeps_non_manifold_edges() const {
        const std::vector<Kind>& kind = s_.features->kind;
        if (kind[r_.a] != Kind::pinned && kind[r_.b] != Kind::pinned) return true;
        const auto faces = [](const Ring& ring, Index v) {
            return std::count_if(ring.begin(), ring.end(), [v](const RingCorner& k) { return k.has(v); });
        };
        const auto found = sides();
        return std::all_of(found.begin(), found.end(), [&](const Side& side) {
            const auto at_a = faces(r_.at_a, side.opposite), at_b = faces(r_.at_b, side.opposite);
            return at_a == 2 || at_b == 2 || (at_a < 2 && at_b < 2);
        });
    }

    /// True if a face of the ring contains both opposite vertices.
    bool joined(const Ring& ring) const {
        const Index x = r_.side[0].opposite, y = r_.side[1].opposite;
        return std::any_of(ring.begin(), ring.end(), [&](const RingCorner& k) {
            return (k.next == x && k.before == y) || (k.next == y && k.before == x);
        });
    }

    /// The flags of the edge between c's vertex and v in the face of c.
    std::uint8_t edge_flags(Index c, Index v) const {
        return s_.edges.flags[s_.tri[after(c)] == v ? c : before(c)];
    }

    /// Finds the wedge at a that takes the faces of each wedge at b.
    bool pair_wedges(bool a_stays) {
        pairs_ = 0;
        for (const Side& side : sides()) {
            const Index to = s_.wedge[side.at_a], from = s_.wedge[side.at_b];
            const Index known = taker(from);
            if (known != none) {
                if (to != known) return false;
                continue;
            }
            // Two wedges may merge into the same wedge only if that wedge keeps its own attributes.
            if (!a_stays)
                for (int k = 0; k < pairs_; ++k)
                    if (pair_[k][0] == to) return false;
            if (s_.features->side_of_wedge)
                for (int k = 0; k < pairs_; ++k)
                    if (pair_[k][0] == to &&
                        (*s_.features->side_of_wedge)[pair_[k][1]] != (*s_.features->side_of_wedge)[from])
                        return false;
            pair_[pairs_][0] = to;
            pair_[pairs_][1] = from;
            ++pairs_;
        }
        return std::all_of(r_.at_b.begin(), r_.at_b.end(),
                           [&](const RingCorner& k) { return taker(s_.wedge[k.corner]) != none; });
    }

    Index taker(Index wedge) const {
        for (int i = 0; i < pairs_; ++i)
            if (pair_[i][1] == wedge) return pair_[i][0];
        return none;
    }

    /// True if the remaining faces of the ring keep their orientation when v moves.
    bool keeps_facing(Index v, const Ring& ring, Index other, const Vec3& to) const {
        const Vec3& from = s_.at[v];
        for (const RingCorner& k : ring) {
            if (k.has(other)) continue;
            const Vec3 &x = s_.at[k.next], &y = s_.at[k.before], along = y - x;
            const Vec3 old = cross(x - from, along), now = cross(x - to, along);
            const double was = dot(old, old), is = dot(now, now);
            const double least = least_area(x, y, to);
            const bool flat = is < least * least;
            if (is <= 4 * was && is_near(old, now) && !(flat && is < was)) continue;
            if (!(was >= 0)) continue; // not finite
            const double before = least_area(x, y, from);
            if (was < before * before ? !flat && !faces_as_across(k, now)
                                      : !is_near(old, now) || (flat && is < was))
                return false;
        }
        return true;
    }

    /// A flat face has no orientation to keep. When it gets an area, it must face like its neighbour across
    /// the unmoved edge, if that neighbour has an orientation.
    bool faces_as_across(const RingCorner& k, const Vec3& now) const {
        for (Index c = s_.rings.first[k.before]; c != none; c = s_.rings.next[c]) {
            if (!s_.live(c / 3) || s_.tri[after(c)] != k.next) continue;
            const Vec3 &x = s_.at[k.before], &y = s_.at[k.next],
                       &z = s_.at[s_.tri[simplification::before(c)]];
            const Vec3 across = cross(y - x, z - x);
            const double least = least_area(x, y, z);
            return dot(across, across) < least * least || is_near(across, now);
        }
        return true;
    }

    void hand_over_wedges(Collapses& log) {
        for (int i = 0; i < pairs_; ++i)
            if (pair_[i][0] != pair_[i][1]) {
                if (s_.log) log.wedges.push_back({pair_[i][0], pair_[i][1]});
                if (s_.weighs_attributes()) join(*s_.quadrics->attributes, pair_[i][0], pair_[i][1]);
            }
        for (const RingCorner& k : r_.at_b) s_.wedge[k.corner] = taker(s_.wedge[k.corner]);
    }

    /// Moves the surviving corners into a's list, and clears b's list.
    void join_lists() {
        Index* link = &s_.rings.first[r_.a];
        const auto add = [&](Index c) {
            *link = c;
            link = &s_.rings.next[c];
        };
        for (const RingCorner& k : r_.at_a)
            if (!k.has(r_.b)) add(k.corner);
        for (const RingCorner& k : r_.at_b) {
            if (k.has(r_.a)) continue;
            add(k.corner);
            s_.tri[k.corner] = r_.a;
        }
        *link = none;
        s_.rings.first[r_.b] = none;
    }

    /// The edges from a and b to the opposite vertex merge. The result is a feature if either edge was.
    void pass_on_features(const Side& side) {
        const auto either = static_cast<std::uint8_t>(
            (edge_flags(side.at_a, side.opposite) | edge_flags(side.at_b, side.opposite)) &
            (boundary_edge | feature_edge));
        if (!either) return;
        for (Index c = s_.rings.first[r_.a]; c != none; c = s_.rings.next[c]) {
            if (s_.tri[after(c)] == side.opposite) s_.edges.flags[c] |= either;
            if (s_.tri[before(c)] == side.opposite) s_.edges.flags[before(c)] |= either;
        }
    }

    State& s_;
    Around& r_;
    Index pair_[Around::max_sides][2] = {}; // wedge at a, wedge at b
    int pairs_ = 0;
};

} // namespace

Attempt collapse(State& s, Index c, Around& around, Pricer& pricer, Tally& tally) {
    const Index u = s.tri[c], v = s.tri[after(c)];
    const std::uint8_t flags = s.edges.flags[c];
    const Placement p = place(s, c, flags);
    const Index a = around.a = p.keep_second ? v : u, b = around.b = p.keep_second ? u : v;
    const bool stays = p.keep_first || p.keep_second;
    Collapse edit(s, around);
    const bool held = s.bounds.limits && !(p.error < std::min((*s.bounds.limits)[a], (*s.bounds.limits)[b]));
    auto why = held ? blocked_border : edit.refusal(p.at, stays, flags & feature_edge, flags & boundary_edge);
    if (!why && p.error > s.bounds.max_squared_error) why = blocked_error;
    if (why == outside) return Attempt::outside;
    if (why == later) return Attempt::later;
    if (why) {
        s.edges.flags[c] |= why;
        s.edges.cost[c] = never;
        return Attempt::refused;
    }
    s.features->kind[a] = std::max(s.features->kind[a], s.features->kind[b]);
    if (s.bounds.limits) (*s.bounds.limits)[a] = std::min((*s.bounds.limits)[a], (*s.bounds.limits)[b]);
    const auto [faces, vertices] = edit.make(p.at, p.error, tally.log);
    s.at[a] = p.at;
    s.moved[a] |= !stays;
    s.order.touched[a] = s.order.touched[b] = s.order.pass;
    if (s.quadrics) {
        s.quadrics->near[a] = rounded<float>(p.joined);
        if (s.quadrics->fine) (*s.quadrics->fine)[a] = rounded<double>(p.joined);
        if (s.quadrics->attributes && !s.has_seams()) join(*s.quadrics->attributes, a, b);
    }
    tally.largest = std::max(tally.largest, p.error);
    edit.price(pricer);
    ++tally.collapses;
    tally.faces += faces;
    tally.vertices += vertices;
    return Attempt::done;
}

} // namespace facetmill::simplification

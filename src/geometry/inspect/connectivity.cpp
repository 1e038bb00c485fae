#include "geometry/inspect/connectivity.hpp"

#include "mesh/buckets.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <cstdlib>

namespace facetmill {

namespace {

/// A face seen from one of its vertices: the vertices before and after it.
struct Wing {
    Index vertex, before, after;
};

/// A side of a wing: the edge from the vertex to `to`, along which the face leaves the vertex or arrives at
/// it. The slot identifies wing and side.
struct Side {
    Index to, slot; ///< slot: 2 * wing, plus 1 if the face leaves the vertex
    bool operator<(const Side& b) const { return to != b.to ? to < b.to : slot < b.slot; }
};

using EdgeKey = std::uint64_t;
EdgeKey key_of(Index a, Index b) { return EdgeKey{std::min(a, b)} << 32 | std::max(a, b); }

/// The contribution of a bucket of vertices.
struct Found {
    Connectivity counts;
    std::vector<EdgeKey> boundary;                  ///< boundary edges, each once
    std::vector<std::pair<EdgeKey, EdgeKey>> turns; ///< boundary edges that follow each other around a fan
};

void sort_sides(std::vector<Side>& sides) {
    if (sides.size() > 48) {
        std::sort(sides.begin(), sides.end());
        return;
    }
    for (std::size_t i = 1; i < sides.size(); ++i) {
        const Side side = sides[i];
        std::size_t j = i;
        for (; j > 0 && side < sides[j - 1]; --j) sides[j] = sides[j - 1];
        sides[j] = side;
    }
}

/// Examines the wings of one vertex after the other, and reuses its memory.
class LinkReader {
  public:
    LinkReader(bool triangles, std::span<const Turn> turns, Found& found)
        : triangles_(triangles && turns.empty()), turns_(turns), found_(found) {}

    void read(Index v, std::span<const Wing> wings) {
        if (turn_of(v) != Turn::now) return;
        if (wings.empty()) {
            ++found_.counts.isolated_vertices;
            return;
        }
        if (is_closed_fan(v, wings)) {
            for (const Wing& w : wings) found_.counts.edges += counts_edge(v, w.before);
            if (triangles_ && wings.size() == 2)
                count_duplicates(v, wings); // if there are more than two wings, no two are equal
            return;
        }
        sides_.clear();
        for (Index i = 0; i < wings.size(); ++i) {
            if (wings[i].before != v) sides_.push_back({wings[i].before, 2 * i});
            if (wings[i].after != v) sides_.push_back({wings[i].after, 2 * i + 1});
        }
        sort_sides(sides_);
        read_edges(v, wings.size());
        read_fans(v, wings.size());
        if (triangles_) count_duplicates(v, wings);
    }

  private:
    Turn turn_of(Index v) const { return turns_.empty() ? Turn::now : turns_[v]; }
    /// Whether the wings go round v once consistently, which is usual: each ends where exactly one other
    /// begins. All edges then have two uses, which cancel, and form a single fan. This test needs no
    /// sorting.
    static bool is_closed_fan(Index v, std::span<const Wing> wings) {
        constexpr std::size_t most = 16; // limit, because each wing is compared with all others
        if (wings.size() > most) return false;
        std::size_t at = 0, passed = 0;
        do {
            const Index to = wings[at].after;
            if (to == v) return false;
            std::size_t next = 0, found = 0;
            for (std::size_t i = 0; i < wings.size(); ++i) {
                const bool here = wings[i].before == to;
                next = here ? i : next;
                found += here;
            }
            if (found != 1) return false;
            at = next;
            ++passed;
        } while (at != 0 && passed < wings.size());
        return at == 0 && passed == wings.size();
    }
    /// Whether v is the end at which the edge is counted.
    bool counts_edge(Index v, Index to) const {
        return turn_of(to) == Turn::now ? v < to : turn_of(to) == Turn::later;
    }

    /// Reads edges: runs of sides to the same vertex are the uses of an edge.
    void read_edges(Index v, std::size_t wings) {
        partner_.assign(2 * wings, none);
        ends_.clear();
        crowded_ = false;
        for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
            const Index to = sides_[begin].to;
            std::int64_t balance = 0;
            for (; end < sides_.size() && sides_[end].to == to; ++end)
                balance += sides_[end].slot & 1 ? 1 : -1;
            const std::size_t uses = end - begin;
            crowded_ = crowded_ || uses > 2;
            if (uses == 2) {
                partner_[sides_[begin].slot] = sides_[begin + 1].slot;
                partner_[sides_[begin + 1].slot] = sides_[begin].slot;
            }
            if (uses == 1) ends_.push_back(sides_[begin]);
            if (counts_edge(v, to)) count_edge(key_of(v, to), uses, balance);
        }
    }

    void count_edge(EdgeKey key, std::size_t uses, std::int64_t balance) {
        Connectivity& n = found_.counts;
        ++n.edges;
        n.uncancelled_edges += balance != 0;
        n.disagreeing_edges += std::abs(balance) > 1;
        n.crowded_edges += uses > 2;
        if (uses == 1) {
            ++n.boundary_edges;
            found_.boundary.push_back(key);
        }
    }

    /// The number of wings passed when walking from a slot across wings, until the fan ends or closes.
    std::size_t walk(Index slot, Index& last) const {
        const Index start = slot;
        std::size_t passed = 0;
        do {
            ++passed;
            last = slot ^ 1;
            slot = partner_[last];
        } while (slot != none && slot != start);
        return passed;
    }

    void read_fans(Index v, std::size_t wings) {
        if (!crowded_ && ends_.size() <= 2 && sides_.size() == 2 * wings) {
            Index last = none;
            const bool one_fan = walk(ends_.empty() ? 0 : ends_[0].slot, last) == wings;
            if (one_fan) {
                if (!ends_.empty()) found_.turns.emplace_back(key_of(v, ends_[0].to), key_of(v, ends_[1].to));
                return;
            }
        }
        read_several_fans(v, wings);
    }

    /// Handles the general case: wings that share an edge belong to the same fan, as do the boundary edges
    /// at its ends.
    void read_several_fans(Index v, std::size_t wings) {
        fan_.resize(wings);
        for (Index i = 0; i < wings; ++i) fan_[i] = i;
        std::size_t fans = wings;
        for (std::size_t i = 1; i < sides_.size(); ++i) {
            if (sides_[i].to != sides_[i - 1].to) continue;
            const Index a = root(sides_[i].slot / 2), b = root(sides_[i - 1].slot / 2);
            if (a != b) {
                fan_[std::max(a, b)] = std::min(a, b);
                --fans;
            }
        }
        if (fans > 1) ++found_.counts.non_manifold_vertices;
        std::sort(ends_.begin(), ends_.end(), [&](const Side& a, const Side& b) {
            const Index fan_a = root(a.slot / 2), fan_b = root(b.slot / 2);
            return fan_a != fan_b ? fan_a < fan_b : a < b;
        });
        for (std::size_t i = 1; i < ends_.size(); ++i)
            if (root(ends_[i].slot / 2) == root(ends_[i - 1].slot / 2))
                found_.turns.emplace_back(key_of(v, ends_[i - 1].to), key_of(v, ends_[i].to));
    }

    Index root(Index i) {
        while (fan_[i] != i) i = fan_[i] = fan_[fan_[i]];
        return i;
    }

    /// Counts each duplicate triangle at its lowest vertex. Triangles with a repeated vertex are counted
    /// elsewhere.
    void count_duplicates(Index v, std::span<const Wing> wings) {
        opposite_.clear();
        for (const Wing& w : wings)
            if (w.before > v && w.after > v && w.before != w.after)
                opposite_.push_back(key_of(w.before, w.after));
        std::sort(opposite_.begin(), opposite_.end());
        for (std::size_t i = 1; i < opposite_.size(); ++i)
            found_.counts.duplicate_triangles += opposite_[i] == opposite_[i - 1];
    }

    bool triangles_;
    std::span<const Turn> turns_; ///< empty: all vertices are Turn::now
    Found& found_;
    bool crowded_ = false;
    std::vector<Side> sides_, ends_;
    std::vector<Index> partner_, fan_;
    std::vector<EdgeKey> opposite_;
};

void join(Found& a, Found&& b) {
    Connectivity& n = a.counts;
    n.edges += b.counts.edges;
    n.boundary_edges += b.counts.boundary_edges;
    n.isolated_vertices += b.counts.isolated_vertices;
    n.uncancelled_edges += b.counts.uncancelled_edges;
    n.crowded_edges += b.counts.crowded_edges;
    n.disagreeing_edges += b.counts.disagreeing_edges;
    n.non_manifold_vertices += b.counts.non_manifold_vertices;
    n.duplicate_triangles += b.counts.duplicate_triangles;
    a.boundary.insert(a.boundary.end(), b.boundary.begin(), b.boundary.end());
    a.turns.insert(a.turns.end(), b.turns.begin(), b.turns.end());
}

std::int64_t count_loops(Found& found) {
    auto& edges = found.boundary;
    std::sort(edges.begin(), edges.end());
    const auto number = [&](EdgeKey key) {
        return static_cast<Index>(std::lower_bound(edges.begin(), edges.end(), key) - edges.begin());
    };
    DisjointSets loops(edges.size());
    parallel_for(found.turns.size(), [&](std::size_t i) {
        loops.join(number(found.turns[i].first), number(found.turns[i].second));
    });
    std::int64_t count = 0;
    for (Index e = 0; e < edges.size(); ++e) count += loops.find(e) == e;
    return count;
}

/// Sorts the wings of a bucket by vertex and reads each vertex.
void read_bucket(std::span<const Wing> wings, std::size_t first, std::size_t last, LinkReader& reader) {
    std::vector<Wing> sorted(wings.size());
    std::vector<Index> ends(last - first, 0);
    for (const Wing& w : wings) ++ends[w.vertex - first];
    exclusive_scan(ends);
    for (const Wing& w : wings) sorted[ends[w.vertex - first]++] = w;
    Index begin = 0;
    for (std::size_t v = first; v < last; ++v) {
        const Index end = ends[v - first];
        reader.read(static_cast<Index>(v), {sorted.data() + begin, sorted.data() + end});
        begin = end;
    }
}

} // namespace

Connectivity connectivity_of(const Mesh& mesh) { return connectivity_of(mesh, {}); }

Connectivity connectivity_of(const Mesh& mesh, std::span<const Turn> turns) {
    const auto buckets = fill_buckets<Wing>(mesh, [&](Index f, auto&& emit) {
        const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
        if (begin == end) return;
        Index before = mesh.vertex(end - 1), v = mesh.vertex(begin);
        for (Index c = begin; c < end; ++c) {
            const Index after = mesh.vertex(next_corner(c, begin, end));
            emit(v, Wing{v, before, after});
            before = v;
            v = after;
        }
    });
    Found all = parallel_reduce(
        buckets.count(), Found{},
        [&](std::size_t begin, std::size_t end) {
            Found found;
            LinkReader reader(mesh.all_triangles(), turns, found);
            for (std::size_t b = begin; b < end; ++b)
                read_bucket(buckets.of(b), buckets.first_vertex(b),
                            std::min(mesh.vertex_count(), buckets.first_vertex(b + 1)), reader);
            return found;
        },
        [](Found a, Found&& b) {
            join(a, std::move(b));
            return a;
        },
        buckets.at_once());
    if (turns.empty()) all.counts.boundary_loops = count_loops(all);
    return all.counts;
}

} // namespace facetmill

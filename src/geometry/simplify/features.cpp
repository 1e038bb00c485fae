#include "geometry/simplify/features.hpp"

#include "base/math/whole_number.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace facetmill::simplification {

namespace {

/// A face of the one-ring of a vertex. It runs from the neighbour `in` through the vertex, at `corner`, to
/// the neighbour `out`, so the edge of the corner leads to `out`.
struct RingFace {
    Index out, in, corner;
};

/// A label per face, in the work's order; empty when all labels are equal.
using Labels = std::vector<Index>;

Labels labels_of(const State& s, const Mesh& mesh, std::string_view name) {
    const Attribute* a = mesh.find(name, Domain::face);
    if (!a || a->components != 1) return {};
    Labels list;
    resize_large(list, s.face_slots());
    parallel_for(list.size(),
                 [&](std::size_t f) { list[f] = whole_number<Index>(a->value(s.face_source[f], 0)); });
    const bool several = std::any_of(list.begin(), list.end(), [&](Index x) { return x != list[0]; });
    return several ? list : Labels{};
}

/// Everything that separates the faces of a mesh.
struct Borders {
    Labels primitives, groups;
};

class Classifier {
  public:
    /// corner_cosine: the cosine of the turning angle that makes a boundary vertex a corner; empty: no
    /// corners.
    Classifier(State& s, const Borders& borders, const SimplifyLocks& lock,
               std::optional<double> corner_cosine)
        : s_(s), borders_(borders), lock_(lock), corner_cosine_(corner_cosine) {}

    Kind operator()(Index v) {
        if (is_plain(v)) return Kind::smooth;
        const Kind kind = look(v);
        if (kind == Kind::pinned) flag_around_pinned(v);
        return kind;
    }

  private:
    static constexpr std::size_t few = 16;

    /// True if a few faces close around the vertex without a feature between them, as at most vertices. Needs
    /// no sorting.
    bool is_plain(Index v) {
        std::array<RingFace, few> ring;
        std::size_t size = 0;
        for (Index c = s_.rings.first[v]; c != none; c = s_.rings.next[c]) {
            const Index out = s_.tri[after(c)], in = s_.tri[before(c)];
            if (size == few || out == v || in == v || out == in) return false;
            ring[size++] = {out, in, c};
        }
        std::array<std::size_t, few> then{};
        for (std::size_t i = 0; i < size; ++i) {
            then[i] = few;
            for (std::size_t j = 0; j < size; ++j) then[i] = ring[j].out == ring[i].in ? j : then[i];
            if (then[i] == few || differ(ring[i], ring[then[i]])) return false;
        }
        std::size_t steps = 1; // length of the cycle: `size` if it visits every face
        for (std::size_t i = then[0]; i != 0 && steps <= size; i = then[i]) ++steps;
        return steps == size;
    }

    Kind look(Index v) {
        ring_.clear();
        ins_.clear();
        for (Index c = s_.rings.first[v]; c != none; c = s_.rings.next[c]) {
            const Index out = s_.tri[after(c)], in = s_.tri[before(c)];
            if (out == v || in == v || out == in) return Kind::pinned;
            ring_.push_back({out, in, c});
            ins_.push_back(in);
        }
        std::sort(ring_.begin(), ring_.end(), [](const RingFace& a, const RingFace& b) {
            return a.out != b.out ? a.out < b.out : a.corner < b.corner;
        });
        std::sort(ins_.begin(), ins_.end());
        for (std::size_t i = 1; i < ring_.size(); ++i)
            if (ring_[i].out == ring_[i - 1].out || ins_[i] == ins_[i - 1]) return Kind::pinned;
        return walk();
    }

    /// Flags the edges that leave a pinned vertex like `walk` does, but only between two faces that agree.
    /// Features of its neighbours end at these edges, and may be collapsed into the vertex.
    void flag_around_pinned(Index v) {
        ring_.clear();
        for (Index c = s_.rings.first[v]; c != none; c = s_.rings.next[c])
            ring_.push_back({s_.tri[after(c)], s_.tri[before(c)], c});
        std::sort(ring_.begin(), ring_.end(), [](const RingFace& a, const RingFace& b) {
            return a.out != b.out ? a.out < b.out : a.corner < b.corner;
        });
        ins_.clear();
        for (const RingFace& face : ring_) ins_.push_back(face.in);
        std::sort(ins_.begin(), ins_.end());
        for (const RingFace& face : ring_)
            if (!std::binary_search(ins_.begin(), ins_.end(), face.out) && !leads_twice(face.out))
                s_.edges.flags[face.corner] |= boundary_edge | feature_edge;
        for (const RingFace& face : ring_) {
            const RingFace* then = leading_to(face.in);
            if (then && differ(face, *then)) s_.edges.flags[then->corner] |= feature_edge;
        }
    }

    /// True if several faces lead from the vertex to `out`.
    bool leads_twice(Index out) const {
        const RingFace* first = leading_to(out);
        return first + 1 != ring_.data() + ring_.size() && first[1].out == out;
    }

    /// Goes around the fan, and flags the edges that leave the vertex.
    Kind walk() {
        const RingFace* start = nullptr;
        for (const RingFace& face : ring_) {
            if (std::binary_search(ins_.begin(), ins_.end(), face.out)) continue;
            if (start) return Kind::pinned; // two fans
            start = &face;
        }
        const bool open = start != nullptr;
        if (!open) start = ring_.data();
        int features = open ? 2 : 0;
        const RingFace* now = start;
        features_.clear();
        locked_ = open && lock_.boundary;
        for (std::size_t steps = 1;; ++steps) {
            const RingFace* then = leading_to(now->in);
            if (!then || (then == start && !open)) {
                if (steps != ring_.size()) return Kind::pinned; // more than one fan
                if (then && differ(*now, *then)) features_.push_back(then->corner);
                break;
            }
            if (differ(*now, *then)) features_.push_back(then->corner);
            now = then;
        }
        for (const Index c : features_) s_.edges.flags[c] |= feature_edge;
        if (open) {
            s_.edges.flags[start->corner] |= boundary_edge | feature_edge;
            locked_ |= turns_between(now->in, s_.tri[start->corner], start->out);
        }
        features += static_cast<int>(features_.size());
        if (features == 0) return Kind::smooth;
        return features == 2 && !locked_ ? Kind::curve : Kind::corner;
    }

    /// True if the boundary has a corner at v.
    bool turns_between(Index before, Index v, Index after) const {
        if (!corner_cosine_) return false;
        const Vec3 in = normalised(s_.at[v] - s_.at[before]), out = normalised(s_.at[after] - s_.at[v]);
        return exceeds_feature_angle(dot(in, out), *corner_cosine_);
    }

    const RingFace* leading_to(Index other) const {
        const auto at = std::lower_bound(ring_.begin(), ring_.end(), other,
                                         [](const RingFace& a, Index o) { return a.out < o; });
        return at != ring_.end() && at->out == other ? &*at : nullptr;
    }

    /// True if the edge between two neighbouring faces of the fan is a seam or a border.
    bool differ(const RingFace& now, const RingFace& then) {
        const Index f = now.corner / 3, g = then.corner / 3;
        const bool group = !borders_.groups.empty() && borders_.groups[f] != borders_.groups[g];
        const bool seam =
            (!borders_.primitives.empty() && borders_.primitives[f] != borders_.primitives[g]) ||
            (s_.has_seams() && (s_.wedge[now.corner] != s_.wedge[then.corner] ||
                                s_.wedge[before(now.corner)] != s_.wedge[after(then.corner)]));
        locked_ |= (group && lock_.groups) || (seam && lock_.seams);
        return group || seam;
    }

    State& s_;
    const Borders& borders_;
    const SimplifyLocks& lock_;
    std::optional<double> corner_cosine_;
    bool locked_ = false; ///< the current vertex
    std::vector<RingFace> ring_;
    std::vector<Index> ins_, features_;
};

/// A boundary edge by the position numbers of its ends, the lower first.
struct OpenEdge {
    Index low, high; ///< position numbers
    Index from, to;  ///< the vertices at these positions
    bool along(const OpenEdge& o) const { return low == o.low && high == o.high; }
};

/// The vertices of the mesh at the ends of every boundary edge of finite length.
std::vector<std::array<Index, 2>> open_edges(const State& s, const Mesh& mesh) {
    std::vector<std::array<Index, 2>> ends;
    for (Index c = 0; c < s.edges.flags.size(); ++c) {
        if (!(s.edges.flags[c] & boundary_edge)) continue;
        const Index u = s.source[s.tri[c]], v = s.source[s.tri[after(c)]];
        if (is_finite(mesh.positions[u]) && is_finite(mesh.positions[v])) ends.push_back({u, v});
    }
    return ends;
}

/// Boundary edges sorted by position, so that coincident edges are adjacent.
std::vector<OpenEdge> by_place(const State& s, const Mesh& mesh) {
    const auto ends = open_edges(s, mesh);
    const auto less = [&](Index a, Index b) {
        const Vec3 &p = mesh.positions[a], &q = mesh.positions[b];
        return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
    };
    std::vector<Index> order;
    for (const auto& [u, v] : ends) {
        order.push_back(u);
        order.push_back(v);
    }
    std::sort(order.begin(), order.end(), less);
    const auto place = [&](Index v) {
        return static_cast<Index>(std::lower_bound(order.begin(), order.end(), v, less) - order.begin());
    };
    std::vector<OpenEdge> edges;
    for (auto [u, v] : ends) {
        Index low = place(u), high = place(v);
        if (low > high) {
            std::swap(low, high);
            std::swap(u, v);
        }
        if (low != high) edges.push_back({low, high, u, v});
    }
    std::sort(edges.begin(), edges.end(), [](const OpenEdge& a, const OpenEdge& b) {
        return std::tie(a.low, a.high, a.from, a.to) < std::tie(b.low, b.high, b.from, b.to);
    });
    return edges;
}

/// Calls body for each pair of coincident edges.
template <class Body>
void for_pairs(const std::vector<OpenEdge>& edges, Body&& body) {
    for (std::size_t i = 1; i < edges.size(); ++i)
        if (edges[i].along(edges[i - 1])) body(edges[i - 1], edges[i]);
}

} // namespace

void classify(State& s, const Mesh& mesh, const SimplifyLocks& lock, std::optional<double> corner_angle) {
    if (corner_angle) corner_angle = cosine(*corner_angle);
    const Borders borders{labels_of(s, mesh, primitive_attribute), labels_of(s, mesh, "group")};
    const auto in_body = [&](const Vec3& p) {
        return !lock.body.empty() && std::all_of(lock.body.begin(), lock.body.end(),
                                                 [&](const Plane& plane) { return side(plane, p) >= 0; });
    };
    Features& features = s.features.emplace();
    features.kind.resize(s.vertex_slots());
    parallel_chunks(s.vertex_slots(), [&](std::size_t begin, std::size_t end) {
        Classifier kind_of(s, borders, lock, corner_angle);
        for (std::size_t v = begin; v < end; ++v) {
            features.kind[v] = kind_of(static_cast<Index>(v));
            const Index source = s.source[v];
            if (in_body(mesh.positions[source]) || (!lock.vertices.empty() && lock.vertices[source]))
                features.kind[v] = std::max(features.kind[v], Kind::corner);
        }
    });
    features.any = parallel_reduce(
                       s.edges.flags.size(), 0,
                       [&](std::size_t begin, std::size_t end) {
                           int any = 0;
                           for (std::size_t c = begin; c < end; ++c) any |= s.edges.flags[c] & feature_edge;
                           return any;
                       },
                       [](int a, int b) { return a | b; }) != 0;
}

std::vector<std::uint8_t> feature_corners(const State& s) {
    if (!s.features || !s.features->any) return {};
    std::vector<std::uint8_t> features(s.edges.flags.size());
    parallel_for(s.edges.flags.size(), [&](std::size_t c) {
        features[3 * s.face_source[c / 3] + c % 3] = s.edges.flags[c] & feature_edge;
    });
    return features;
}

std::vector<Index> CoincidentBorders::find(const State& s, const Mesh& mesh) {
    const std::vector<OpenEdge> edges = by_place(s, mesh);
    bool any = false;
    for_pairs(edges, [&](const OpenEdge&, const OpenEdge&) { any = true; });
    if (!any) return {};
    DisjointSets joined(mesh.vertex_count());
    for_pairs(edges, [&](const OpenEdge& a, const OpenEdge& b) {
        joined.join(a.from, b.from);
        joined.join(a.to, b.to);
    });
    std::vector<Index> target(mesh.vertex_count());
    for (Index v = 0; v < target.size(); ++v) target[v] = joined.find(v);
    return target;
}

CoincidentBorders::CoincidentBorders(Mesh& mesh, const std::vector<Index>& target)
    : sides_(mesh.wedge_count()), had_seams_(mesh.has_seams()) {
    for (Index w = 0; w < sides_.size(); ++w) sides_[w] = mesh.vertex_of_wedge(w);
    mesh.wedge_vertex.resize(sides_.size());
    for (std::size_t w = 0; w < sides_.size(); ++w) mesh.wedge_vertex[w] = target[sides_[w]];
    for (Attribute& a : mesh.attributes) {
        if (a.domain != Domain::vertex) continue;
        a.select(sides_);
        a.domain = Domain::wedge;
        of_vertices_.push_back(a.name);
    }
}

void CoincidentBorders::separate(Mesh& mesh, const std::vector<Index>& wedges, AttributeChanges& changes,
                                 std::vector<Index>& sources) const {
    std::vector<Index> first(mesh.vertex_count(), none);
    std::vector<Index> wedge_of(mesh.vertex_count(), none); // the wedge of each vertex
    std::map<std::pair<Index, Index>, Index> others;        // wedges by vertex and side
    for (Index w = 0; w < wedges.size(); ++w) {
        Index& v = mesh.wedge_vertex[w];
        const Index side = sides_[wedges[w]];
        if (first[v] == none) first[v] = side;
        if (first[v] != side) {
            const auto [at, fresh] = others.try_emplace({v, side}, static_cast<Index>(mesh.positions.size()));
            if (fresh) {
                mesh.positions.push_back(Vec3(mesh.positions[v]));
                wedge_of.push_back(none);
            }
            v = at->second;
        }
        wedge_of[v] = w;
    }
    if (!sources.empty()) {
        sources.resize(wedge_of.size());
        for (std::size_t v = 0; v < wedge_of.size(); ++v) sources[v] = sides_[wedges[wedge_of[v]]];
    }
    if (!had_seams_) { // every wedge becomes a vertex again
        std::vector<Vec3> positions(wedges.size());
        for (std::size_t w = 0; w < wedges.size(); ++w) positions[w] = mesh.positions[mesh.wedge_vertex[w]];
        mesh.positions = std::move(positions);
        mesh.wedge_vertex = {};
        for (Index w = 0; w < wedges.size(); ++w) wedge_of[w] = w;
        if (!sources.empty()) {
            sources = wedges;
            for (Index& source : sources) source = sides_[source];
        }
    }
    for (const std::string& name : of_vertices_) {
        Attribute& a = *mesh.find(name, Domain::wedge);
        a.select(wedge_of);
        a.domain = Domain::vertex;
        for (AttributeChange& change : changes)
            if (change.attribute == name && change.domain == Domain::wedge) change.domain = Domain::vertex;
    }
}

std::size_t CoincidentBorders::doubled(const State& s) const {
    std::set<std::pair<Index, Index>> seen;
    std::vector<Index> first(s.vertex_slots(), none);
    for (std::size_t c = 0; c < s.tri.size(); ++c) {
        if (!s.live(static_cast<Index>(c / 3))) continue;
        Index& side = first[s.tri[c]];
        if (side == none) side = sides_[s.wedge[c]];
        if (side != sides_[s.wedge[c]]) seen.insert({s.tri[c], sides_[s.wedge[c]]});
    }
    return seen.size();
}

} // namespace facetmill::simplification

// Which vertices may move how: found once, since every collapse that is allowed keeps the answer.

#include "base/parallel.hpp"
#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

namespace {

/// A corner at a vertex: its face runs from the neighbour `in` through the vertex to the neighbour `out`, so
/// the edge of the corner leads to `out`.
struct Spoke {
    Index out, in, corner;
};

/// A number per face, in the work's order; empty when there is only one.
using Labels = std::vector<Index>;

Labels labels_of(const Work& s, const Mesh& mesh, std::string_view name) {
    const Attribute* a = mesh.find(name, Domain::face);
    if (!a || a->components != 1) return {};
    Labels list(s.face_slots());
    parallel_for(list.size(), [&](std::size_t f) {
        list[f] = static_cast<Index>(std::clamp(a->value(s.face_source[f], 0), 0.0, 4294967295.0));
    });
    const bool several = std::any_of(list.begin(), list.end(), [&](Index x) { return x != list[0]; });
    return several ? list : Labels{};
}

/// What parts the faces of a mesh.
struct Borders {
    Labels primitives, groups;
};

class Classifier {
  public:
    Classifier(Work& s, const Borders& borders, const SimplifyLocks& lock)
        : s_(s), borders_(borders), lock_(lock) {}

    Kind operator()(Index v) {
        if (is_plain(v)) return Kind::smooth;
        const Kind kind = look(v);
        if (kind == Kind::pinned) flag_open_edges(v);
        return kind;
    }

  private:
    static constexpr std::size_t few = 16;

    /// Whether a few faces close around the vertex with no feature between them, as at most vertices: told
    /// without sorting.
    bool is_plain(Index v) {
        std::array<Spoke, few> ring;
        std::size_t size = 0;
        for (Index c = s_.first[v]; c != none; c = s_.next[c]) {
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
        std::size_t steps = 1; // of a round that meets all of them: then no neighbour is met twice
        for (std::size_t i = then[0]; i != 0 && steps <= size; i = then[i]) ++steps;
        return steps == size;
    }

    Kind look(Index v) {
        spokes_.clear(), ins_.clear();
        for (Index c = s_.first[v]; c != none; c = s_.next[c]) {
            const Index out = s_.tri[after(c)], in = s_.tri[before(c)];
            if (out == v || in == v || out == in) return Kind::pinned;
            spokes_.push_back({out, in, c});
            ins_.push_back(in);
        }
        std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
            return a.out != b.out ? a.out < b.out : a.corner < b.corner;
        });
        std::sort(ins_.begin(), ins_.end());
        for (std::size_t i = 1; i < spokes_.size(); ++i)
            if (spokes_[i].out == spokes_[i - 1].out || ins_[i] == ins_[i - 1]) return Kind::pinned;
        return walk();
    }

    /// Flags the edges that lead out of a pinned vertex and have one face: its neighbours' loops need to
    /// know.
    void flag_open_edges(Index v) {
        ins_.clear();
        for (Index c = s_.first[v]; c != none; c = s_.next[c])
            ins_.push_back(s_.tri[after(c)]), ins_.push_back(s_.tri[before(c)]);
        std::sort(ins_.begin(), ins_.end());
        for (Index c = s_.first[v]; c != none; c = s_.next[c]) {
            const auto [low, high] = std::equal_range(ins_.begin(), ins_.end(), s_.tri[after(c)]);
            if (high - low == 1) s_.flags[c] |= boundary_edge | feature_edge;
        }
    }

    /// Goes around the fan; flags the edges that lead out of the vertex.
    Kind walk() {
        const Spoke* start = nullptr;
        for (const Spoke& spoke : spokes_) {
            if (std::binary_search(ins_.begin(), ins_.end(), spoke.out)) continue;
            if (start) return Kind::pinned; // two fans
            start = &spoke;
        }
        const bool open = start != nullptr;
        if (!open) start = spokes_.data();
        int features = open ? 2 : 0;
        const Spoke* now = start;
        features_.clear();
        locked_ = open && lock_.boundary;
        for (std::size_t steps = 1;; ++steps) {
            const Spoke* then = leading_to(now->in);
            if (!then || (then == start && !open)) {
                if (steps != spokes_.size()) return Kind::pinned; // a fan and more
                if (then && differ(*now, *then)) features_.push_back(then->corner);
                break;
            }
            if (differ(*now, *then)) features_.push_back(then->corner);
            now = then;
        }
        for (const Index c : features_) s_.flags[c] |= feature_edge;
        if (open) s_.flags[start->corner] |= boundary_edge | feature_edge;
        features += static_cast<int>(features_.size());
        if (features == 0) return Kind::smooth;
        return features == 2 && !locked_ ? Kind::curve : Kind::corner;
    }

    const Spoke* leading_to(Index other) const {
        const auto at = std::lower_bound(spokes_.begin(), spokes_.end(), other,
                                         [](const Spoke& a, Index o) { return a.out < o; });
        return at != spokes_.end() && at->out == other ? &*at : nullptr;
    }

    /// Whether the edge between two neighbouring faces of the fan is a seam or a border.
    bool differ(const Spoke& now, const Spoke& then) {
        const Index f = now.corner / 3, g = then.corner / 3;
        const bool group = !borders_.groups.empty() && borders_.groups[f] != borders_.groups[g];
        const bool seam =
            (!borders_.primitives.empty() && borders_.primitives[f] != borders_.primitives[g]) ||
            (!s_.wedge.empty() && (s_.wedge[now.corner] != s_.wedge[then.corner] ||
                                   s_.wedge[before(now.corner)] != s_.wedge[after(then.corner)]));
        locked_ |= (group && lock_.groups) || (seam && lock_.seams);
        return group || seam;
    }

    Work& s_;
    const Borders& borders_;
    const SimplifyLocks& lock_;
    bool locked_ = false; ///< the vertex looked at
    std::vector<Spoke> spokes_;
    std::vector<Index> ins_, features_;
};

} // namespace

void classify(Work& s, const Mesh& mesh, const SimplifyLocks& lock) {
    const Borders borders{labels_of(s, mesh, primitive_attribute), labels_of(s, mesh, "group")};
    const auto in_body = [&](const Vec3& p) {
        return !lock.body.empty() && std::all_of(lock.body.begin(), lock.body.end(),
                                                 [&](const Plane& plane) { return side(plane, p) >= 0; });
    };
    s.kind.resize(s.vertex_slots());
    parallel_chunks(s.vertex_slots(), [&](std::size_t begin, std::size_t end) {
        Classifier kind_of(s, borders, lock);
        for (std::size_t v = begin; v < end; ++v) {
            s.kind[v] = kind_of(static_cast<Index>(v));
            const Index source = s.source[v];
            if (in_body(mesh.positions[source]) || (!lock.vertices.empty() && lock.vertices[source]))
                s.kind[v] = std::max(s.kind[v], Kind::corner);
        }
    });
    s.has_features = parallel_reduce(
                         s.flags.size(), 0,
                         [&](std::size_t begin, std::size_t end) {
                             int any = 0;
                             for (std::size_t c = begin; c < end; ++c) any |= s.flags[c] & feature_edge;
                             return any;
                         },
                         [](int a, int b) { return a | b; }) != 0;
}

} // namespace facetmill::simplification

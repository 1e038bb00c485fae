#include "geometry/split/marked.hpp"

#include "base/math/portable_math.hpp"
#include "base/progress.hpp"
#include "geometry/split/patterns.hpp"
#include "geometry/split/spots.hpp"

#include <algorithm>
#include <atomic>

namespace facetmill {

namespace {

/// The faces of a mesh, with the marks of their edges to cut.
struct Marked {
    const EdgeTable& table;
    const EdgeMarks& marks;

    bool at(Index c) const { return table.corner_edge[c] != none && marks[table.corner_edge[c]]; }
    int count(const Mesh& mesh, Index f) const {
        int n = 0;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) n += at(c);
        return n;
    }
};

/// Cuts triangles at their marked edges: first across the longest edge, then each half across its marked
/// edge.
struct BisectPattern {
    Marked marked;
    const std::vector<std::uint8_t>& longest; ///< [faces] local number of the longest edge, 3: none

    PatternCounts counts(const Mesh& mesh, Index f) const {
        const auto n = static_cast<std::uint64_t>(1 + marked.count(mesh, f));
        return {n, 3 * n, 0, 0};
    }
    bool triangles_only(const Mesh&) const { return true; }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index k = longest[face.face], first = 3 * face.face;
        if (k == 3 || !marked.at(first + k)) return out.face(face.at(0), face.at(1), face.at(2));
        const Index l = (k + 1) % 3, m = (k + 2) % 3;
        const Index a = face.at(k), b = face.at(l), apex = face.at(m), middle = face.on(k);
        if (marked.at(first + m)) {
            out.face(a, middle, face.on(m));
            out.face(middle, apex, face.on(m));
        } else {
            out.face(a, middle, apex);
        }
        if (marked.at(first + l)) {
            out.face(middle, b, face.on(l));
            out.face(middle, face.on(l), apex);
        } else {
            out.face(middle, b, apex);
        }
    }
};

/// Cuts a triangle by its marks: to the opposite corner, into a triangle and a quad, or into four triangles.
struct NotchPattern {
    Marked marked;

    PatternCounts counts(const Mesh& mesh, Index f) const {
        switch (marked.count(mesh, f)) {
        case 0:
            return {1, 3, 0, 0};
        case 1:
            return {2, 6, 0, 0};
        case 2:
            return {2, 7, 0, 0};
        default:
            return {4, 12, 0, 0};
        }
    }
    bool triangles_only(const Mesh&) const { return false; }
    void emit(const PatternFace& face, PatternOut& out) const {
        const Index first = face.mesh.face_begin(face.face);
        const int n = marked.count(face.mesh, face.face);
        if (n == 0) return out.face(face.at(0), face.at(1), face.at(2));
        if (n == 3) return four_triangles(face, out);
        Index k = 0; // the only marked edge, or the only unmarked edge
        while (marked.at(first + k) != (n == 1)) ++k;
        const Index a = face.at(k), b = face.at((k + 1) % 3), apex = face.at((k + 2) % 3);
        if (n == 1) {
            out.face(a, face.on(k), apex);
            out.face(face.on(k), b, apex);
        } else {
            const Index right = face.on((k + 1) % 3), left = face.on((k + 2) % 3);
            out.face(a, b, right, left);
            out.face(left, right, apex);
        }
    }
};

/// Cuts quads between two opposite edges, and at the marks that neighbours set.
struct HalvePattern {
    Marked marked;
    const std::vector<std::uint8_t>& first_edge; ///< [faces] for quads: the first of the two opposite edges

    bool right(Index begin, Index k) const { return marked.at(begin + (k + 1) % 4); }
    bool left(Index begin, Index k) const { return marked.at(begin + (k + 3) % 4); }

    PatternCounts counts(const Mesh& mesh, Index f) const {
        if (mesh.face_size(f) == 3) return NotchPattern{marked}.counts(mesh, f);
        const Index begin = mesh.face_begin(f), k = first_edge[f];
        const int more = right(begin, k) + left(begin, k);
        return more == 0   ? PatternCounts{2, 8, 0, 0}
               : more == 1 ? PatternCounts{3, 11, 0, 0}
                           : PatternCounts{4, 16, 1, 4};
    }
    bool triangles_only(const Mesh& mesh) const { return mesh.all_triangles(); }
    void emit(const PatternFace& face, PatternOut& out) const {
        if (face.size() == 3) return NotchPattern{marked}.emit(face, out);
        const Index begin = face.mesh.face_begin(face.face), k = first_edge[face.face];
        const Index r = (k + 1) % 4, o = (k + 2) % 4, l = (k + 3) % 4;
        const bool at_right = right(begin, k), at_left = left(begin, k);
        if (at_right && at_left) return QuadsPattern{}.emit(face, out);
        const Index near = face.on(k), far = face.on(o);
        if (at_left) {
            out.face(face.at(k), near, far, face.on(l));
            out.face(far, face.at(l), face.on(l));
        } else {
            out.face(face.at(k), near, far, face.at(l));
        }
        if (at_right) {
            out.face(near, face.at(r), face.on(r), far);
            out.face(face.on(r), face.at(o), far);
        } else {
            out.face(near, face.at(r), face.at(o), far);
        }
    }
};

/// Sets a mark from several threads at once.
void mark(EdgeMarks& marks, Index e) { std::atomic_ref(marks[e]).store(1, std::memory_order_relaxed); }

/// Whether an angle of triangle f is below the angle with this cosine.
bool is_narrow(const Mesh& mesh, Index f, const Transform& to_world, double cosine_of_limit) {
    for (Index k = 0; k < 3; ++k) {
        const Vec3& p = mesh.point(3 * f + k);
        const Vec3 a = to_world.vector(mesh.point(3 * f + (k + 1) % 3) - p),
                   b = to_world.vector(mesh.point(3 * f + (k + 2) % 3) - p);
        if (dot(a, b) > cosine_of_limit * std::sqrt(dot(a, a) * dot(b, b))) return true;
    }
    return false;
}

std::vector<std::uint8_t> chosen_faces(const Mesh& mesh, const SplitSettings& settings) {
    std::vector<std::uint8_t> chosen(mesh.face_count(), 1);
    if (settings.min_angle <= 0) return chosen;
    const double limit = cosine(settings.min_angle);
    parallel_for(chosen.size(), [&](std::size_t f) {
        chosen[f] = is_narrow(mesh, static_cast<Index>(f), settings.to_world, limit);
    });
    return chosen;
}

/// Marks the longest edge of every triangle that has a mark, until nothing changes. The result is the
/// smallest closed set of marks, independent of the order.
void close_marks(const MeasuredEdges& edges, const std::vector<std::uint8_t>& longest, EdgeMarks& marks) {
    std::vector<Index> fresh;
    for (Index e = 0; e < edges.table.size(); ++e)
        if (marks[e]) fresh.push_back(e);
    while (!fresh.empty()) {
        const Index e = fresh.back();
        fresh.pop_back();
        for (const Index c : edges.table.corners_of(e)) {
            const Index next = edges.table.corner_edge[c - c % 3 + longest[c / 3]];
            if (marks[next]) continue;
            marks[next] = 1;
            fresh.push_back(next);
        }
    }
}

/// The position of the cut on each marked edge: the foot of the bisector of the widest opposite angle.
std::vector<double> feet(const Mesh& mesh, const MeasuredEdges& edges, const EdgeMarks& marks,
                         const Transform& to_world) {
    std::vector<double> at(edges.table.size(), 0.5);
    parallel_for(at.size(), [&](std::size_t i) {
        const auto e = static_cast<Index>(i);
        if (!marks[e]) return;
        double widest = 2; // cosine of the widest angle so far
        for (const Index c : edges.table.corners_of(e)) {
            const Vec3& apex = mesh.point(c - c % 3 + (c % 3 + 2) % 3);
            const Vec3 low = to_world.vector(mesh.positions[edges.table.edges[e].low] - apex),
                       high = to_world.vector(mesh.positions[edges.table.edges[e].high] - apex);
            const double a = length(low), b = length(high);
            const double cosine_here = a * b > 0 ? dot(low, high) / (a * b) : 1;
            if (!(cosine_here < widest)) continue;
            widest = cosine_here;
            // A bisector divides the opposite edge in the ratio of the adjacent sides.
            at[e] = a + b > 0 ? std::clamp(a / (a + b), 0.001, 0.999) : 0.5;
        }
    });
    return at;
}

std::optional<Mesh> bisected(const Mesh& mesh, const SplitSettings& settings, SplitResult& so_far) {
    const MeasuredEdges edges = measure_edges(mesh, settings.to_world);
    const auto longest = longest_edges(mesh, edges);
    const auto chosen = chosen_faces(mesh, settings);
    EdgeMarks marks(edges.table.size());
    parallel_for(chosen.size(), [&](std::size_t f) {
        if (chosen[f] && longest[f] < 3) mark(marks, edges.table.corner_edge[3 * f + longest[f]]);
    });
    if (settings.min_angle > 0) {
        if (std::find(marks.begin(), marks.end(), 1) == marks.end()) return {};
        close_marks(edges, longest, marks);
    }
    return cut_marked(mesh, edges, marks, longest, settings.cut, settings.to_world, so_far);
}

std::optional<Mesh> notched(const Mesh& mesh, const SplitSettings& settings, SplitResult& so_far) {
    const MeasuredEdges edges = measure_edges(mesh, settings.to_world);
    const auto chosen = chosen_faces(mesh, settings);
    EdgeMarks marks(edges.table.size());
    parallel_for(chosen.size(), [&](std::size_t f) {
        if (!chosen[f]) return;
        const Index* e = &edges.table.corner_edge[3 * f];
        std::size_t shortest = 3; // ties use the edge with higher vertices
        for (std::size_t k = 0; k < 3; ++k)
            if (e[k] != none && (shortest == 3 || edges.squared[e[k]] < edges.squared[e[shortest]] ||
                                 (edges.squared[e[k]] == edges.squared[e[shortest]] && e[k] > e[shortest])))
                shortest = k;
        for (std::size_t k = 0; k < 3; ++k)
            if (e[k] != none && k != shortest) mark(marks, e[k]);
    });
    if (settings.min_angle > 0 && std::find(marks.begin(), marks.end(), 1) == marks.end()) return {};
    so_far.shared += shared_cuts(mesh, edges.table, marks);
    const EdgePoints points(mesh, edges.table, 2, marks);
    return apply_pattern(mesh, &points, NotchPattern{{edges.table, marks}}, so_far.changes);
}

/// Counts pairs of quads that are cut between the same two edges, so that their new edges coincide.
std::size_t twin_cuts(const Mesh& mesh, const EdgeTable& table, const std::vector<std::uint8_t>& first_edge) {
    std::vector<std::uint64_t> pairs;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_size(f) != 4) continue;
        const Index c = mesh.face_begin(f) + first_edge[f];
        const std::uint64_t a = table.corner_edge[c], b = table.corner_edge[c + 2];
        pairs.push_back(std::min(a, b) << 32 | std::max(a, b));
    }
    radix_sort(pairs, [](std::uint64_t p) { return p; });
    std::size_t twins = 0;
    for (std::size_t i = 1; i < pairs.size(); ++i) twins += pairs[i] == pairs[i - 1];
    return twins;
}

Mesh halved(const Mesh& mesh, const SplitSettings& settings, SplitResult& so_far) {
    const MeasuredEdges edges = measure_edges(mesh, settings.to_world);
    std::vector<std::uint8_t> first_edge(mesh.face_count());
    EdgeMarks marks(edges.table.size());
    parallel_for(first_edge.size(), [&](std::size_t i) {
        const auto f = static_cast<Index>(i);
        if (mesh.face_size(f) != 4) return;
        const Index* e = &edges.table.corner_edge[mesh.face_begin(f)];
        const auto long_is = [&](std::size_t k) {
            return e[k] == none ? 0.0 : std::sqrt(edges.squared[e[k]]);
        };
        const std::uint8_t k = long_is(0) + long_is(2) >= long_is(1) + long_is(3) ? 0 : 1;
        first_edge[f] = k;
        for (const std::size_t cut : {std::size_t{k}, std::size_t{k} + 2})
            if (e[cut] != none) mark(marks, e[cut]);
    });
    so_far.shared += shared_cuts(mesh, edges.table, marks) + twin_cuts(mesh, edges.table, first_edge);
    const EdgePoints points(mesh, edges.table, 2, marks);
    return apply_pattern(mesh, &points, HalvePattern{{edges.table, marks}, first_edge}, so_far.changes);
}

} // namespace

MeasuredEdges measure_edges(const Mesh& mesh, const Transform& to_world) {
    MeasuredEdges edges{build_edges(mesh), {}};
    edges.squared.resize(edges.table.size());
    parallel_for(edges.squared.size(), [&](std::size_t e) {
        const auto& [low, high] = edges.table.edges[e];
        const Vec3 d = to_world.vector(mesh.positions[high] - mesh.positions[low]);
        edges.squared[e] = dot(d, d);
    });
    return edges;
}

std::vector<std::uint8_t> longest_edges(const Mesh& mesh, const MeasuredEdges& edges) {
    std::vector<std::uint8_t> longest(mesh.face_count());
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        double best = -1;
        Index best_edge = none;
        std::uint8_t found = 3;
        for (std::uint8_t k = 0; k < 3; ++k) {
            const Index e = edges.table.corner_edge[3 * f + k];
            if (e == none) continue;
            const double squared = edges.squared[e];
            if (squared > best || (squared == best && e < best_edge)) {
                best = squared;
                best_edge = e;
                found = k;
            }
        }
        longest[f] = found;
    });
    return longest;
}

Mesh cut_marked(const Mesh& mesh, const MeasuredEdges& edges, const EdgeMarks& marks,
                const std::vector<std::uint8_t>& longest, SplitSettings::Cut cut, const Transform& to_world,
                SplitResult& so_far) {
    so_far.shared += shared_cuts(mesh, edges.table, marks);
    std::vector<double> at;
    if (cut == SplitSettings::Cut::widest_angle) at = feet(mesh, edges, marks, to_world);
    const EdgePoints points(mesh, edges.table, 2, marks, std::move(at));
    return apply_pattern(mesh, &points, BisectPattern{{edges.table, marks}, longest}, so_far.changes);
}

std::size_t narrow_faces(const Mesh& mesh, const SplitSettings& settings) {
    if (settings.min_angle <= 0) return 0;
    const auto chosen = chosen_faces(mesh, settings);
    return static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), 1));
}

std::optional<Mesh> split_marked(const Mesh& mesh, const SplitSettings& settings, SplitResult& so_far) {
    if (settings.method == SplitMethod::bisect) return bisected(mesh, settings, so_far);
    if (settings.method == SplitMethod::notch) return notched(mesh, settings, so_far);
    return halved(mesh, settings, so_far);
}

// --- bisect with targets: passes over the edges that are too long, or over the longest edges within a
// budget.

namespace {

/// Marks edges and their closure, one edge at a time, as long as the faces stay within the budget.
class Budget {
  public:
    Budget(const MeasuredEdges& edges, const std::vector<std::uint8_t>& longest, std::uint64_t room)
        : edges_(edges), longest_(longest), room_(room) {}

    /// Returns false, and marks nothing, if the cost exceeds the remaining budget.
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

/// The edges longer than the limit (squared), the longest first. A round with a budget uses only edges
/// longer than half the longest, because the pieces of a cut edge are at most that long.
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
    for (ProgressRounds rounds; result.stop != Stop::budget; rounds.next()) {
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

// Bounds on what simplification does to the surface: max_error while collapsing and afterwards, and the
// limits that keep it from running into itself.
//
// While collapsing, points of the surface that came in are followed from face to face. All collapses are
// logged; if the deviation that is measured in the end is above the bound, the log is cut by bisection. Every
// beginning of it is a mesh, so nothing is run again.

#include "geometry/simplify/methods.hpp"

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/group_distances.hpp"
#include "mesh/placement.hpp"

#include <atomic>
#include <utility>

namespace facetmill::simplification {

namespace {

// Of the bound, for what is guarded while collapsing: the vertices as they came. Between them, and seen from
// the new surface, the deviation is a little larger.
constexpr double guarded_share = 0.9;
// A face as near to a point as this share of the bound (squared) is not compared with others.
constexpr double near_enough = 0.01;
// Where on a face that stays, by the weights of its other two vertices, it is asked how far the surface is.
constexpr std::pair<double, double> places_on_face[]{
    {1.0 / 3, 1.0 / 3}, {0.5, 0}, {0.5, 0.5}, {1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}};
constexpr float share_left = 1.0f / 4; // of a squared error where faces cross: half the distance

/// The vertices of the surface and the centres of its faces, each with one of its faces.
FollowedPoints follow_points(const State& s) {
    const std::size_t vertices = s.vertex_slots(), faces = s.face_slots();
    FollowedPoints f;
    f.points = s.at;
    f.points.resize(vertices + faces);
    f.next.assign(f.points.size(), none);
    f.first.assign(faces, none);
    for (std::size_t v = 0; v < vertices; ++v)
        f.next[v] = std::exchange(f.first[s.rings.first[v] / 3], static_cast<Index>(v));
    parallel_for(faces, [&](std::size_t i) {
        f.points[vertices + i] =
            (s.at[s.tri[3 * i]] + s.at[s.tri[3 * i + 1]] + s.at[s.tri[3 * i + 2]]) * (1.0 / 3);
        f.next[vertices + i] = std::exchange(f.first[i], static_cast<Index>(vertices + i));
    });
    return f;
}

/// Calls body(corner) for the faces around the edge.
template <class Body>
void for_faces(const Around& r, Body&& body) {
    for (const RingCorner& k : r.at_a) body(k);
    for (const RingCorner& k : r.at_b)
        if (!k.has(r.a)) body(k);
}

bool keeps_points(const State& s, Around& r, const Vec3& to) {
    const FollowedPoints& followed = *s.bounds.followed;
    r.points.clear();
    r.taken_by.clear();
    r.staying.clear();
    for_faces(r, [&](const RingCorner& k) {
        if (!k.has(r.a) && !k.has(r.b)) r.staying.push_back(k);
        const Index f = k.corner / 3;
        for (Index p = followed.first[f]; p != none; p = followed.next[p]) r.points.push_back(p);
    });
    r.points_at.clear();
    for (const Index i : r.points) r.points_at.push_back(followed.points[i]);
    r.bounds.begin(to, r.points_at);
    for (const RingCorner& k : r.staying) r.bounds.add(s.at[k.next], s.at[k.before]);
    for (std::size_t i = 0; i < r.points.size(); ++i) {
        const Vec3& p = r.points_at[i];
        double least = HUGE_VAL;
        Index taker = none;
        for (Index k = 0; k < r.staying.size() && least > near_enough * followed.farthest; ++k) {
            if (r.bounds.square(k, i) >= least) continue;
            const Vec3 &x = s.at[r.staying[k].next], &y = s.at[r.staying[k].before];
            const Vec3 off = p - closest_on_triangle(p, to, x, y);
            if (!(dot(off, off) < least)) continue;
            least = dot(off, off);
            taker = k;
        }
        if (!(least <= followed.farthest)) return false;
        r.taken_by.push_back(taker);
    }
    return true;
}

/// Whether the new vertex and places on the faces at it are near the surface that came in: near a point of it
/// that the face took, or else near any place.
bool is_near(const State& s, Around& r, const Vec3& to) {
    const FollowedPoints& followed = *s.bounds.followed;
    r.places.assign(1, to);
    for (const RingCorner& k : r.staying) {
        const Vec3 &x = s.at[k.next], &y = s.at[k.before];
        for (const auto& [a, b] : places_on_face) r.places.push_back(to * (1 - a - b) + x * a + y * b);
    }
    r.near.assign(r.places.size(), 0);
    const auto look = [&](std::size_t place, const Vec3& p) {
        const Vec3 off = r.places[place] - p;
        if (dot(off, off) <= followed.farthest) r.near[place] = 1;
    };
    for (std::size_t i = 0; i < r.points.size(); ++i) {
        const Vec3& p = followed.points[r.points[i]];
        look(0, p);
        for (std::size_t k = 0; k < std::size(places_on_face); ++k)
            look(1 + std::size(places_on_face) * r.taken_by[i] + k, p);
    }
    const double bound = std::sqrt(followed.farthest) / s.frame.scale;
    Index hint = none;
    for (std::size_t i = 0; i < r.places.size(); ++i) {
        if (r.near[i]) continue;
        const Closest found = closest_point(*followed.input, s.frame.outside(r.places[i]), hint, bound);
        if (!(found.distance <= bound)) return false;
        hint = found.triangle;
    }
    return true;
}

/// Whether one of the points is farther than `bound` from a surface; neighbours are looked at together.
bool any_beyond(std::span<const Vec3> points, GroupDistances& together, const FaceTree& tree, double bound,
                Index& hint) {
    if (together.all_within(points, bound, hint)) return false;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (together.distance(i) + together.error() <= bound) continue;
        const Closest found = closest_point(tree, points[i], hint, bound);
        if (!(found.distance <= bound)) return true;
        hint = found.triangle;
    }
    return false;
}

/// Whether a point of one surface (of those that the deviation samples) is farther than `bound` from another.
bool any_beyond(const Surface& surface, const FaceTree& tree, double bound,
                const DeviationSettings& settings) {
    const auto samples = sample_area(surface, settings.samples, settings.seed);
    const std::size_t all = samples.size() + surface.positions.size();
    std::atomic<bool> found = false;
    parallel_chunks(
        all,
        [&](std::size_t begin, std::size_t end) {
            GroupDistances together(tree);
            std::vector<Vec3> points;
            Index hint = none;
            for (std::size_t i = begin; i < end && !found; ++i) {
                points.push_back(i < samples.size() ? samples[i].point
                                                    : surface.positions[i - samples.size()]);
                if (points.size() < GroupDistances::most && i + 1 < end) continue;
                if (any_beyond(points, together, tree, bound, hint)) found = true;
                points.clear();
            }
        },
        2048);
    return found;
}

/// The positions and faces alone, without vertices that no face uses.
Mesh bare_used(const Mesh& from) {
    Mesh out = bare(from);
    drop_unused(out);
    return out;
}

/// Where the vertices of an origin went by some beginning of a log.
struct Moves {
    std::vector<Index> root;         ///< of each vertex of the origin
    std::vector<Vec3> at;            ///< of roots
    std::vector<std::uint8_t> moved; ///< of roots
};

Moves moves_after(const Origin& o, const Log& log, std::size_t steps) {
    const std::size_t vertices = o.shape.vertex_slots();
    Moves m{std::vector<Index>(vertices), o.shape.at, std::vector<std::uint8_t>(vertices)};
    parallel_for(vertices, [&](std::size_t v) { m.root[v] = static_cast<Index>(v); });
    for (std::size_t i = 0; i < steps; ++i) {
        const Step& step = log.steps[i];
        const Index a = o.number[step.a];
        m.moved[a] |= !(m.at[a] == step.to);
        m.at[a] = step.to;
    }
    for (std::size_t i = steps; i-- > 0;) // from the last, so that what a became is known
        m.root[o.number[log.steps[i].b]] = m.root[o.number[log.steps[i].a]];
    return m;
}

/// Whether a face is still there: one that was flat from the start stays.
bool stands(const Origin& o, const Moves& m, std::size_t f) {
    const Index a = o.shape.tri[3 * f], b = o.shape.tri[3 * f + 1], c = o.shape.tri[3 * f + 2];
    const Index x = m.root[a], y = m.root[b], z = m.root[c];
    return (x != y && y != z && z != x) || a == b || b == c || c == a;
}

/// The positions and faces after the first so many steps of the log.
Mesh bare_after(const Origin& o, const Mesh& from, const Log& log, std::size_t steps) {
    const Moves m = moves_after(o, log, steps);
    Mesh mesh;
    mesh.positions.resize(m.at.size());
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        mesh.positions[v] = m.moved[v] ? o.shape.frame.outside(m.at[v]) : from.positions[o.shape.source[v]];
    });
    for (std::size_t f = 0; f < o.shape.face_slots(); ++f)
        if (stands(o, m, f))
            for (std::size_t k = 0; k < 3; ++k) mesh.corners.push_back(m.root[o.shape.tri[3 * f + k]]);
    drop_unused(mesh);
    return mesh;
}

/// The wedge that each of the input became by the first so many merges; empty without seams.
std::vector<Index> wedge_roots(const Shape& shape, const Log& log, std::size_t merges) {
    if (!shape.has_seams()) return {};
    std::vector<Index> root(*std::max_element(shape.wedge.begin(), shape.wedge.end()) + std::size_t{1});
    for (std::size_t w = 0; w < root.size(); ++w) root[w] = static_cast<Index>(w);
    for (std::size_t i = merges; i-- > 0;) root[log.wedges[i].b] = root[log.wedges[i].a];
    return root;
}

/// The longest beginning of the log, shorter than all of it, that was found good; to one percent of what is
/// left.
std::size_t longest_good(const Origin& origin, const Mesh& from, const Log& log, const Judge& judge,
                         std::size_t& measurements) {
    const std::size_t vertices = origin.shape.vertex_slots();
    std::size_t good = 0, bad = log.steps.size();
    ShareOfRounds rounds;
    while (bad - good > std::max<std::size_t>(1, (vertices - good) / 100)) {
        // What is wrong is most likely near the end: there the errors are the largest.
        const std::size_t back =
            std::min((bad - good + 1) / 2, std::max<std::size_t>(1, (vertices - bad) / 4));
        const std::size_t middle = good == 0 ? bad - back : good + (bad - good) / 2;
        ++measurements;
        (judge.within(bare_after(origin, from, log, middle)) ? good : bad) = middle;
        rounds.next();
    }
    return good;
}

/// Of each vertex of the input, the largest squared error of the steps that went into it.
std::vector<float> largest_errors(const Log& log, std::size_t vertices) {
    std::vector<float> largest(vertices, 0);
    for (const Step& step : log.steps)
        largest[step.a] = std::max({largest[step.a], largest[step.b], step.error});
    return largest;
}

} // namespace

bool points_stay_near(const State& s, Around& around, const Vec3& to) {
    return keeps_points(s, around, to) && is_near(s, around, to);
}

void hand_over_points(State& s, const Around& around) {
    FollowedPoints& followed = *s.bounds.followed;
    for_faces(around, [&](const RingCorner& k) { followed.first[k.corner / 3] = none; });
    for (std::size_t i = 0; i < around.points.size(); ++i) {
        const Index face = around.staying[around.taken_by[i]].corner / 3;
        followed.next[around.points[i]] = std::exchange(followed.first[face], around.points[i]);
    }
}

Judge::Judge(const Mesh& from, double bound, std::size_t samples)
    : surface_(surface_of(bare_used(from))), tree_(surface_, FaceTree::Use::near),
      bound_(bound), settings_{.samples = samples} {}

bool Judge::within(const Mesh& mesh) const {
    const Surface now = surface_of(mesh);
    ShareOfSteps steps({1, 1});
    if (any_beyond(now, tree_, bound_, settings_)) return false;
    steps.next();
    return !any_beyond(surface_, FaceTree(now, FaceTree::Use::near), bound_, settings_);
}

double Judge::deviation(const Mesh& mesh) const {
    const Surface now = surface_of(mesh);
    ShareOfSteps steps({1, 1});
    const double forward = deviation_to(surface_, FaceTree(now, FaceTree::Use::near), settings_).maximum;
    steps.next();
    return std::max(forward, deviation_to(now, tree_, settings_).maximum);
}

Origin::Origin(const Shape& now, std::size_t vertices) : shape(now), number(vertices, none) {
    parallel_for(shape.source.size(),
                 [&](std::size_t v) { number[shape.source[v]] = static_cast<Index>(v); });
}

Shape rolled_back(const Origin& origin, Log& log, std::size_t steps) {
    const Shape& o = origin.shape;
    Moves m = moves_after(origin, log, steps);
    const std::size_t merges = steps > 0 ? log.steps[steps - 1].wedges : 0;
    log.steps.resize(steps);
    log.wedges.resize(merges);
    const std::vector<Index> wedge_root = wedge_roots(o, log, merges);
    Shape s{.frame = o.frame, .at = std::move(m.at), .source = o.source, .moved = std::move(m.moved)};
    for (std::size_t f = 0; f < o.face_slots(); ++f) {
        if (!stands(origin, m, f)) continue;
        s.face_source.push_back(o.face_source[f]);
        for (std::size_t c = 3 * f; c < 3 * f + 3; ++c) {
            s.tri.push_back(m.root[o.tri[c]]);
            if (o.has_seams()) s.wedge.push_back(wedge_root[o.wedge[c]]);
        }
    }
    drop_unused(s);
    return s;
}

Ended run_within(State s, const Mesh& from, const Goal& goal, double max_error, std::size_t samples) {
    const Origin origin(s, from.vertex_count());
    const Judge judge(from, max_error, samples);
    const double limit = guarded_share * max_error * s.frame.scale;
    s.bounds.followed = follow_points(s);
    s.bounds.followed->input = &judge.tree();
    s.bounds.followed->farthest = limit * limit;
    ShareOfSteps steps({4, 4, 1});
    Ended end;
    end.outcome = run_passes(s, goal);
    steps.next();
    end.blocked = count_blocked(s);
    end.by_error = end.outcome.stuck && end.blocked.error > 0;
    compact(s);
    end.log = std::move(s.log);
    Log& log = *end.log;
    const std::size_t all = log.steps.size();
    end.measurements = 1;
    bool good = false;
    {
        const Share first(0, 0.2);
        good = judge.within(bare_after(origin, from, log, all));
    }
    if (!good) {
        const Share others(0.2, 1);
        end.by_error = true;
        const std::size_t steps = longest_good(origin, from, log, judge, end.measurements);
        end.rolled_back = all - steps;
        end.shape = rolled_back(origin, log, steps);
    } else {
        end.shape = std::move(s);
    }
    steps.next();
    end.measured = judge.deviation(bare_after(origin, from, log, log.steps.size()));
    end.outcome.collapses = log.steps.size();
    end.outcome.largest = 0;
    for (const Step& step : log.steps)
        end.outcome.largest = std::max(end.outcome.largest, double(step.error));
    return end;
}

std::size_t limit_intersecting(const Shape& shape, const Log& log, const Mesh& finished, std::size_t allowed,
                               bool to_zero, std::vector<float>& limits) {
    const SelfIntersections found = find_self_intersections(finished, {.limit = SIZE_MAX});
    if (found.count <= allowed) return found.count;
    const std::vector<float> largest = largest_errors(log, limits.size());
    std::vector<float> wanted(limits.size(), never);
    for (const auto& [f, g] : found.pairs)
        for (const Index face : {f, g})
            for (Index k = 0; k < 3; ++k) {
                const Index v = shape.source[shape.tri[3 * face + k]];
                wanted[v] = to_zero ? 0 : largest[v] * share_left;
            }
    // What went into a vertex has its limit; from the last step, so that the change of a is known.
    for (auto step = log.steps.rbegin(); step != log.steps.rend(); ++step)
        wanted[step->b] = std::min(wanted[step->b], wanted[step->a]);
    for (std::size_t v = 0; v < limits.size(); ++v) limits[v] = std::min(limits[v], wanted[v]);
    return found.count;
}

} // namespace facetmill::simplification

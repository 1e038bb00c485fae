// Bounds on the surface error of simplification: max_error during and after the collapses, and the limits
// that avoid self-intersections.
//
// During the collapses, points of the input surface are followed from face to face. All collapses are logged.
// If the final deviation exceeds the bound, the log is cut by bisection. Every prefix of the log is a mesh,
// so nothing is run again.

#include "geometry/simplify/methods.hpp"

#include "base/progress.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/closest_point.hpp"
#include "geometry/spatial/group_distances.hpp"
#include "mesh/placement.hpp"
#include "parallel/parallel.hpp"

#include <array>
#include <atomic>
#include <utility>

namespace facetmill::simplification {

namespace {

// The share of the bound that the collapses may use, because only the input vertices are checked. Between
// them, and measured from the new surface, the deviation is a little larger.
constexpr double guarded_share = 0.9;
// If a face is closer to a point than this share of the bound (squared), other faces are not compared.
constexpr double near_enough = 0.01;
// A face that takes more points drops the centres. It replaces so many faces that their centres are as close
// to it as the vertices around them.
constexpr Index many_points = 256;
constexpr float share_left = 1.0f / 4; // factor of squared errors where faces intersect: halves the distance

/// The vertices of the surface and the centres of its faces, each with one of its faces. input: the tree of
/// the mesh that the state was built from; the faces keep that mesh's numbers.
FollowedPoints follow_points(const State& s, const Mesh& from, const FaceTree& input) {
    const std::size_t vertices = s.vertex_slots(), faces = s.face_slots();
    FollowedPoints f{.input = &input, .vertices = vertices};
    std::vector<Index> triangle_of(from.face_count(), none);
    parallel_for(input.faces.size(),
                 [&](std::size_t t) { triangle_of[input.faces[t]] = static_cast<Index>(t); });
    f.triangles.resize(faces);
    parallel_for(faces, [&](std::size_t i) { f.triangles[i] = triangle_of[s.face_source[i]]; });
    f.points.resize(vertices + faces);
    f.first.assign(faces, none);
    const auto put = [&f](std::size_t i, std::size_t face, const Vec3& at) {
        f.points[i] = {at, std::exchange(f.first[face], static_cast<Index>(i))};
    };
    for (std::size_t v = 0; v < vertices; ++v) put(v, s.rings.first[v] / 3, s.at[v]);
    parallel_for(faces, [&](std::size_t i) {
        put(vertices + i, i,
            (s.at[s.tri[3 * i]] + s.at[s.tri[3 * i + 1]] + s.at[s.tri[3 * i + 2]]) * (1.0 / 3));
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

/// Prepares the surviving faces, with the new vertex.
void lay_fan(const State& s, Around& r, const Vec3& to) {
    const FollowedPoints& followed = *s.bounds.followed;
    for_faces(r, [&](const RingCorner& k) { fetch_soon(followed.first[k.corner / 3]); });
    r.staying.clear();
    double reach = 0;
    const auto reaches = [&](Index v) {
        const Vec3 off = s.at[v] - to;
        reach = std::max({reach, std::abs(off.x), std::abs(off.y), std::abs(off.z)});
    };
    reaches(r.a);
    reaches(r.b);
    for_faces(r, [&](const RingCorner& k) {
        if (k.has(r.a) || k.has(r.b)) return;
        r.staying.push_back(k);
        reaches(k.next);
        reaches(k.before);
    });
    for (int i = 0; i < r.sides; ++i) reaches(r.side[static_cast<std::size_t>(i)].opposite);
    for_faces(r, [&](const RingCorner& k) {
        if (const Index first = followed.first[k.corner / 3]; first != none)
            fetch_soon(followed.points[first]);
    });
    const double farthest = std::sqrt(followed.farthest);
    r.bounds.begin(to, reach + farthest, farthest); // points are at most as far from the faces as before
    for (const RingCorner& k : r.staying) r.bounds.add(s.at[k.next], s.at[k.before]);
}

/// The nearest of the surviving faces, or any face that is near enough; none if all are too far.
Index taker_of(const State& s, const Around& r, const Vec3& to, const Vec3& p, std::size_t lane) {
    const double farthest = s.bounds.followed->farthest;
    const auto first = static_cast<Index>(r.bounds.nearest(lane));
    if (r.bounds.most(lane) <= farthest) return first;
    double least = HUGE_VAL;
    Index taker = none;
    const auto compare = [&](Index k) {
        const Vec3 &x = s.at[r.staying[k].next], &y = s.at[r.staying[k].before];
        const Vec3 off = p - closest_on_triangle(p, to, x, y);
        if (!(dot(off, off) < least)) return;
        least = dot(off, off);
        taker = k;
    };
    if (first != none) compare(first);
    for (Index k = 0; k < r.staying.size() && least > near_enough * farthest; ++k)
        if (k != first && r.bounds.square(k, lane) < least && r.bounds.square(k, lane) <= farthest)
            compare(k);
    return least <= farthest ? taker : none;
}

/// Finds the faces that take the next points, up to four. Returns false if no face takes a point; that point
/// is then the next in the list.
bool take_points(const State& s, Around& r, const Vec3& to) {
    std::array<Vec3, 4> at;
    const std::size_t begin = r.taken_by.size();
    const std::size_t count = std::min(at.size(), r.points.size() - begin);
    for (std::size_t i = 0; i < count; ++i) at[i] = s.bounds.followed->points[r.points[begin + i]].at;
    r.bounds.look(std::span(at).first(count));
    for (std::size_t i = 0; i < count; ++i) {
        const Index taker = taker_of(s, r, to, at[i], i);
        if (taker == none) return false;
        r.bounds.note_near(taker, i);
        r.taken_by.push_back(taker);
    }
    return true;
}

/// Makes points[lost] the first of its face's list. firsts: how many of the points are first in a list. The
/// rest of each list follows them in one run.
void move_to_front(FollowedPoints& followed, const Around& r, std::size_t firsts, std::size_t lost) {
    if (lost < firsts) return;
    const auto next = [&](std::size_t i) -> Index& { return followed.points[r.points[i]].next; };
    std::size_t begin = lost; // the first point of the list
    while (begin > firsts && next(begin - 1) == r.points[begin]) --begin;
    std::size_t first = 0;
    while (next(first) != r.points[begin]) ++first;
    next(begin == lost ? first : lost - 1) = next(lost);
    next(lost) = r.points[first];
    for_faces(r, [&](const RingCorner& k) {
        if (Index& f = followed.first[k.corner / 3]; f == r.points[first]) f = r.points[lost];
    });
}

/// True if all points of the faces around are taken. A point that is not taken becomes the first of its face.
/// First points are tested first, so the next attempt nearby soon fails at it.
bool keeps_points(State& s, Around& r, const Vec3& to) {
    FollowedPoints& followed = *s.bounds.followed;
    r.points.clear();
    r.taken_by.clear();
    lay_fan(s, r, to);
    bool kept = true;
    std::size_t firsts = 0;
    for_faces(r, [&](const RingCorner& k) { firsts += followed.first[k.corner / 3] != none; });
    const auto take = [&] {
        if (take_points(s, r, to)) return;
        kept = false;
        move_to_front(followed, r, firsts, r.taken_by.size());
    };
    const auto add = [&](Index p) {
        r.points.push_back(p);
        if (const Index next = followed.points[p].next; next != none) fetch_soon(followed.points[next]);
        if (r.points.size() == r.taken_by.size() + 4) take();
    };
    for_faces(r, [&](const RingCorner& k) {
        if (const Index first = followed.first[k.corner / 3]; kept && first != none) add(first);
    });
    for_faces(r, [&](const RingCorner& k) {
        const Index first = followed.first[k.corner / 3];
        if (!kept || first == none) return;
        for (Index p = followed.points[first].next; kept && p != none; p = followed.points[p].next) add(p);
    });
    if (kept && r.points.size() > r.taken_by.size()) take();
    return kept;
}

/// The triangle of the nearest centre among the points, in the tree's order; none if there is no centre.
Index triangle_near(const FollowedPoints& followed, std::span<const Index> points, const Vec3& place) {
    double least = HUGE_VAL;
    Index nearest = none;
    for (const Index p : points) {
        if (p < followed.vertices) continue;
        const Vec3 off = followed.points[p].at - place;
        if (!(dot(off, off) < least)) continue;
        least = dot(off, off);
        nearest = p;
    }
    return nearest == none ? none : followed.triangles[nearest - followed.vertices];
}

/// True if the new vertex and sample points on its faces are near the input surface. It tries the input
/// points that the face took first, then the whole surface.
bool is_near(const State& s, const Around& r, const Vec3& to) {
    constexpr unsigned at_vertex = 3u << FanBounds::places;
    const FollowedPoints& followed = *s.bounds.followed;
    const double bound = std::sqrt(followed.farthest) / s.frame.scale;
    const auto reaches = [&](const Vec3& place) {
        const Index hint = triangle_near(followed, r.points, place);
        return closest_point(*followed.input, s.frame.outside(place), hint, bound).distance <= bound;
    };
    unsigned any = 0;
    for (std::size_t k = 0; k < r.staying.size(); ++k) {
        const unsigned near = r.bounds.near(k);
        any |= near;
        const Vec3 &x = s.at[r.staying[k].next], &y = s.at[r.staying[k].before];
        for (std::size_t i = 0; i < FanBounds::places; ++i) {
            if (near >> i & 1) continue;
            const double b = FanBounds::weight_b[i], c = FanBounds::weight_c[i];
            if (!reaches(to * (1 - b - c) + x * b + y * c)) return false;
        }
    }
    return (any & at_vertex) != 0 || reaches(to);
}

/// True if one of the points is farther than `bound` from a surface; tests neighbouring points together.
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

/// True if a sample point of the first surface (as the deviation samples it) is farther than `bound` from the
/// second.
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

/// Positions and faces only, without unused vertices.
Mesh bare_used(const Mesh& from) {
    Mesh out = bare(from);
    drop_unused(out);
    return out;
}

/// The movement of an origin's vertices through a prefix of a log.
struct Moves {
    std::vector<Index> root;         ///< [vertices of the origin] the vertex that each merged into
    std::vector<Vec3> at;            ///< [roots] positions
    std::vector<std::uint8_t> moved; ///< [roots] 1 for moved vertices
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
    for (std::size_t i = steps; i-- > 0;) // backwards, so that the target of a is already known
        m.root[o.number[log.steps[i].b]] = m.root[o.number[log.steps[i].a]];
    return m;
}

/// True if a face survives. Faces that were flat in the origin also survive.
bool stands(const Origin& o, const Moves& m, std::size_t f) {
    const Index a = o.shape.tri[3 * f], b = o.shape.tri[3 * f + 1], c = o.shape.tri[3 * f + 2];
    const Index x = m.root[a], y = m.root[b], z = m.root[c];
    return (x != y && y != z && z != x) || a == b || b == c || c == a;
}

/// Positions and faces after the first `steps` steps of the log.
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

/// The wedge that each input wedge became through the first `merges` merges; empty without seams.
std::vector<Index> wedge_roots(const Shape& shape, const Log& log, std::size_t merges) {
    if (!shape.has_seams()) return {};
    std::vector<Index> root(*std::max_element(shape.wedge.begin(), shape.wedge.end()) + std::size_t{1});
    for (std::size_t w = 0; w < root.size(); ++w) root[w] = static_cast<Index>(w);
    for (std::size_t i = merges; i-- > 0;) root[log.wedges[i].b] = root[log.wedges[i].a];
    return root;
}

/// The longest proper prefix of the log that is within the bound, to one percent of the remaining vertices.
std::size_t longest_good(const Origin& origin, const Mesh& from, const Log& log, const Judge& judge,
                         std::size_t& measurements) {
    const std::size_t vertices = origin.shape.vertex_slots();
    std::size_t good = 0, bad = log.steps.size();
    ProgressRounds rounds;
    while (bad - good > std::max<std::size_t>(1, (vertices - good) / 100)) {
        // The cause is most likely near the end, where the errors are the largest.
        const std::size_t back =
            std::min((bad - good + 1) / 2, std::max<std::size_t>(1, (vertices - bad) / 4));
        const std::size_t middle = good == 0 ? bad - back : good + (bad - good) / 2;
        ++measurements;
        (judge.within(bare_after(origin, from, log, middle)) ? good : bad) = middle;
        rounds.next();
    }
    return good;
}

/// [vertices of the input] The largest squared error of the steps that merged each vertex.
std::vector<float> largest_errors(const Log& log, std::size_t vertices) {
    std::vector<float> largest(vertices, 0);
    for (const Step& step : log.steps)
        largest[step.a] = std::max({largest[step.a], largest[step.b], step.error});
    return largest;
}

} // namespace

bool points_stay_near(State& s, Around& around, const Vec3& to) {
    return keeps_points(s, around, to) && is_near(s, around, to);
}

void hand_over_points(State& s, const Around& around) {
    FollowedPoints& followed = *s.bounds.followed;
    for_faces(around, [&](const RingCorner& k) { followed.first[k.corner / 3] = none; });
    std::array<Index, 2 * Ring::max_size> taken{};
    for (const Index taker : around.taken_by) ++taken[taker];
    for (std::size_t i = around.points.size(); i-- > 0;) { // backwards, so that first points stay first
        const Index taker = around.taken_by[i], face = around.staying[taker].corner / 3,
                    point = around.points[i];
        if (point >= followed.vertices && taken[taker] > many_points) continue;
        followed.points[point].next = std::exchange(followed.first[face], point);
    }
}

Judge::Judge(const Mesh& from, double bound, std::size_t samples)
    : surface_(surface_of(bare_used(from))), tree_(surface_, FaceTree::Use::near),
      bound_(bound), settings_{.samples = samples, .means = false} {}

bool Judge::within(const Mesh& mesh) const {
    const Surface now = surface_of(mesh);
    ProgressSteps steps({1, 1});
    if (any_beyond(now, tree_, bound_, settings_)) return false;
    steps.next();
    return !any_beyond(surface_, FaceTree(now, FaceTree::Use::near), bound_, settings_);
}

double Judge::deviation(const Mesh& mesh) const {
    const Surface now = surface_of(mesh);
    ProgressSteps steps({1, 1});
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
    s.bounds.followed = follow_points(s, from, judge.tree());
    s.bounds.followed->farthest = limit * limit;
    ProgressSteps steps({4, 2});
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
    {
        const ProgressScope first(0, 0.2);
        end.measured = judge.deviation(bare_after(origin, from, log, all));
    }
    if (!(*end.measured <= max_error)) {
        const ProgressScope others(0.2, 1);
        end.by_error = true;
        const std::size_t steps = longest_good(origin, from, log, judge, end.measurements);
        end.rolled_back = all - steps;
        end.shape = rolled_back(origin, log, steps);
        end.measured = judge.deviation(bare_after(origin, from, log, steps));
    } else {
        end.shape = std::move(s);
    }
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
    // Lowers the limit of every vertex that merged into the new vertex. Goes backwards, so that the change
    // of a is known.
    for (auto step = log.steps.rbegin(); step != log.steps.rend(); ++step)
        wanted[step->b] = std::min(wanted[step->b], wanted[step->a]);
    for (std::size_t v = 0; v < limits.size(); ++v) limits[v] = std::min(limits[v], wanted[v]);
    return found.count;
}

} // namespace facetmill::simplification

// The way back through the log of collapses, and the search along it for a bound on the measured deviation.

#include "base/parallel.hpp"
#include "geometry/simplify/judge.hpp"
#include "geometry/simplify/work.hpp"

#include <utility>

namespace facetmill::simplification {

Origin::Origin(const Work& s, std::size_t vertices)
    : tri(s.tri), wedge(s.wedge), source(s.source), face_source(s.face_source), at(s.at),
      number(vertices, none) {
    parallel_for(source.size(), [&](std::size_t v) { number[source[v]] = static_cast<Index>(v); });
}

namespace {

// Of the bound, for what is guarded while collapsing: the vertices as they came. Between them, and seen from
// the new surface, the deviation is a little larger.
constexpr double guarded_share = 0.9;

/// Where the vertices of an origin went by some beginning of a log.
struct Moves {
    std::vector<Index> root;         ///< of each vertex of the origin
    std::vector<Vec3> at;            ///< of roots
    std::vector<std::uint8_t> moved; ///< of roots
};

Moves moves_after(const Work& s, const Origin& o, std::size_t steps) {
    Moves m{{}, o.at, std::vector<std::uint8_t>(o.at.size())};
    m.root.resize(o.at.size());
    parallel_for(m.root.size(), [&](std::size_t v) { m.root[v] = static_cast<Index>(v); });
    for (std::size_t i = 0; i < steps; ++i) {
        const Step& step = s.log.steps[i];
        const Index a = o.number[step.a];
        m.moved[a] |= !(m.at[a] == step.to);
        m.at[a] = step.to;
    }
    for (std::size_t i = steps; i-- > 0;) // from the last, so that what a became is known
        m.root[o.number[s.log.steps[i].b]] = m.root[o.number[s.log.steps[i].a]];
    return m;
}

/// Whether a face is still there: one that was flat from the start stays.
bool stands(const Origin& o, const Moves& m, std::size_t f) {
    const Index a = o.tri[3 * f], b = o.tri[3 * f + 1], c = o.tri[3 * f + 2];
    const Index x = m.root[a], y = m.root[b], z = m.root[c];
    return (x != y && y != z && z != x) || a == b || b == c || c == a;
}

} // namespace

Mesh shape_after(const Work& s, const Mesh& from, const Origin& o, std::size_t steps) {
    const Moves m = moves_after(s, o, steps);
    Mesh mesh;
    mesh.positions.resize(m.at.size());
    parallel_for(mesh.positions.size(), [&](std::size_t v) {
        mesh.positions[v] = m.moved[v] ? m.at[v] / s.scale + s.centre : from.positions[o.source[v]];
    });
    for (std::size_t f = 0; f < o.tri.size() / 3; ++f)
        if (stands(o, m, f))
            for (std::size_t k = 0; k < 3; ++k) mesh.corners.push_back(m.root[o.tri[3 * f + k]]);
    drop_unused(mesh);
    return mesh;
}

void roll_back(Work& s, const Origin& o, std::size_t steps) {
    const Moves m = moves_after(s, o, steps);
    const std::size_t merges = steps > 0 ? s.log.steps[steps - 1].wedges : 0;
    s.log.steps.resize(steps), s.log.wedges.resize(merges);
    std::vector<Index> wedge_root;
    if (!o.wedge.empty()) {
        wedge_root.resize(*std::max_element(o.wedge.begin(), o.wedge.end()) + std::size_t{1});
        for (std::size_t w = 0; w < wedge_root.size(); ++w) wedge_root[w] = static_cast<Index>(w);
        for (std::size_t i = merges; i-- > 0;) wedge_root[s.log.wedges[i].b] = wedge_root[s.log.wedges[i].a];
    }
    s.tri.clear(), s.wedge.clear(), s.face_source.clear();
    for (std::size_t f = 0; f < o.face_source.size(); ++f) {
        if (!stands(o, m, f)) continue;
        s.face_source.push_back(o.face_source[f]);
        for (std::size_t k = 0; k < 3; ++k) {
            s.tri.push_back(m.root[o.tri[3 * f + k]]);
            if (!wedge_root.empty()) s.wedge.push_back(wedge_root[o.wedge[3 * f + k]]);
        }
    }
    s.at = m.at, s.moved = m.moved, s.source = o.source;
    s.flags.clear(), s.cost.clear(), s.quadrics.clear(), s.kind.clear(), s.touched.clear(), s.dirty.clear(),
        s.limit.clear();
    build_lists(s);
    s.live_faces = s.face_slots();
    s.live_vertices = static_cast<std::size_t>(
        std::count_if(s.first.begin(), s.first.end(), [](Index c) { return c != none; }));
}

namespace {

/// The longest beginning of the log, shorter than `bad`, that was found good; to one percent of what is left.
std::size_t longest_good(const Work& s, const Mesh& from, const Origin& origin, const Judge& judge,
                         std::size_t bad, Bounded& result) {
    std::size_t good = 0;
    while (bad - good > std::max<std::size_t>(1, (origin.at.size() - good) / 100)) {
        // What is wrong is most likely near the end: there the errors are the largest.
        const std::size_t back =
            std::min((bad - good + 1) / 2, std::max<std::size_t>(1, (origin.at.size() - bad) / 4));
        const std::size_t middle = good == 0 ? bad - back : good + (bad - good) / 2;
        ++result.measurements;
        (judge.within(shape_after(s, from, origin, middle)) ? good : bad) = middle;
    }
    return good;
}

} // namespace

void place_points(Work& s) {
    const std::size_t vertices = s.vertex_slots(), faces = s.face_slots();
    s.points = s.at;
    s.points.resize(vertices + faces);
    s.next_point.assign(s.points.size(), none);
    s.first_point.assign(faces, none);
    for (std::size_t v = 0; v < vertices; ++v)
        s.next_point[v] = std::exchange(s.first_point[s.first[v] / 3], static_cast<Index>(v));
    parallel_for(faces, [&](std::size_t f) {
        s.points[vertices + f] =
            (s.at[s.tri[3 * f]] + s.at[s.tri[3 * f + 1]] + s.at[s.tri[3 * f + 2]]) * (1.0 / 3);
        s.next_point[vertices + f] = std::exchange(s.first_point[f], static_cast<Index>(vertices + f));
    });
}

Bounded run_within(Work& s, const Mesh& from, const Goal& goal, double max_error) {
    place_points(s);
    const Origin origin(s, from.vertex_count());
    const Judge judge(from, max_error);
    s.given = &judge.tree();
    const double limit = guarded_share * max_error * s.scale;
    Goal bounded = goal;
    bounded.error = limit * limit;
    Bounded result;
    result.outcome = run_passes(s, bounded);
    result.blocked = count_blocked(s);
    result.by_error = result.outcome.stuck && result.blocked.error > 0;
    const std::size_t all = s.log.steps.size();
    ++result.measurements;
    if (!judge.within(shape_after(s, from, origin, all))) {
        result.by_error = true;
        const std::size_t good = longest_good(s, from, origin, judge, all, result);
        result.rolled_back = all - good;
        roll_back(s, origin, good);
    }
    s.points = {}, s.next_point = {}, s.first_point = {}, s.given = nullptr;
    result.measured = judge.deviation(shape_after(s, from, origin, s.log.steps.size()));
    result.outcome.collapses = s.log.steps.size(), result.outcome.largest = 0;
    for (const Step& step : s.log.steps)
        result.outcome.largest = std::max(result.outcome.largest, double(step.error));
    return result;
}

} // namespace facetmill::simplification

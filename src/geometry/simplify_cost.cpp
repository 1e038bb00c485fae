// What a collapse costs and where its vertex goes.

#include "base/parallel.hpp"
#include "geometry/simplify_work.hpp"

namespace facetmill::simplification {

namespace {

// Weights of the planes that stand on feature edges, per squared length of the edge, relative to faces per
// area.
constexpr double boundary_weight = 10, feature_weight = 1;
// How strongly the new vertex is drawn to the middle of the edge, relative to the quadric's weight: decides
// only where the planes leave the vertex free, as in flat and straight regions.
constexpr double pull = 1e-8;
// Short edges go first where errors are equal: as if each vertex were displaced by a thousandth of the edge.
constexpr double shortness = 1e-6;
// The order is that of the sum of squared distances over the area^(3/4): between the sum, which lets small
// parts go far off, and the mean, which spends faces on them. Over scans the maximum is a third below the
// sum's, and the root mean square a few percent above.

/// Adds the plane through the edge of corner c, upright on its face.
void add_upright(Quadric& q, const Work& s, Index c, const Vec3& normal) {
    if (!(s.flags[c] & feature_edge)) return;
    const Vec3& from = s.at[s.tri[c]];
    const Vec3 along = s.at[s.tri[after(c)]] - from;
    const double weight = (s.flags[c] & boundary_edge ? boundary_weight : feature_weight) * dot(along, along);
    const Vec3 side = normalised(cross(along, normal));
    if (side != Vec3{}) q += Quadric::plane(side, from, weight);
}

Quadric quadric_at(const Work& s, Index v) {
    Quadric q;
    for (Index c = s.first[v]; c != none; c = s.next[c]) {
        const Vec3& p = s.at[v];
        const Vec3 area = cross(s.at[s.tri[after(c)]] - p, s.at[s.tri[before(c)]] - p);
        const double twice = length(area);
        if (!(twice > 0)) continue;
        const Vec3 normal = area / twice;
        q += Quadric::plane(normal, p, 0.5 * twice);
        if (s.has_features) add_upright(q, s, c, normal), add_upright(q, s, before(c), normal);
    }
    return q;
}

/// Chooses where two ends that are both free to move should meet.
void choose_place(Placement& p, const Quadric& q, const Vec3& a, const Vec3& b, bool endpoints) {
    const Vec3 middle = mix(a, b, 0.5);
    if (!endpoints) {
        p.at = q.weight > 0 ? q.least(middle, pull * q.weight) : middle;
        const Vec3 off = p.at - middle, edge = b - a;
        // Far off the edge the system was near singular: its ends and middle are safer.
        if (dot(off, off) <= 4 * dot(edge, edge)) return;
    }
    const double at_a = q(a), at_b = q(b), at_middle = q(middle);
    if (!endpoints && at_middle <= at_a && at_middle <= at_b)
        p.at = middle;
    else if (at_a <= at_b)
        p.at = a, p.keep_first = true;
    else
        p.at = b, p.keep_second = true;
}

/// Adds a quadric that is no sum of planes: the weight stays.
void add_keeping_weight(Quadric& q, const Quadric& other) {
    const double weight = q.weight;
    q += other;
    q.weight = weight;
}

/// The corner that runs the other way along the edge, or none.
Index opposite(const Work& s, Index corner) {
    const Index from = s.tri[after(corner)], to = s.tri[corner];
    for (Index c = s.first[from]; c != none; c = s.next[c])
        if (s.live(c / 3) && s.tri[after(c)] == to) return c;
    return none;
}

/// What the attributes at both ends pay; on a seam, those of both sides.
void add_fields(Quadric& q, const Work& s, Index corner, bool along) {
    if (s.wedge.empty())
        return add_keeping_weight(q, residual(s.fields, s.tri[corner], s.tri[after(corner)]));
    const Index a = s.wedge[corner], b = s.wedge[after(corner)];
    add_keeping_weight(q, residual(s.fields, a, b));
    const Index other = along ? opposite(s, corner) : none;
    if (other == none) return;
    const Index x = s.wedge[after(other)], y = s.wedge[other];
    if (x != a || y != b) add_keeping_weight(q, residual(s.fields, x, y));
}

} // namespace

void sum_quadrics(Work& s) {
    s.quadrics.resize(s.vertex_slots());
    parallel_for(s.vertex_slots(),
                 [&](std::size_t v) { s.quadrics[v] = quadric_at(s, static_cast<Index>(v)); });
}

Placement place(const Work& s, Index corner, std::uint8_t flags) {
    Placement p;
    const Index u = s.tri[corner], v = s.tri[after(corner)];
    const Kind ku = s.kind[u], kv = s.kind[v];
    if (ku == Kind::pinned || kv == Kind::pinned) return p;
    const bool along = flags & feature_edge;
    if (ku != Kind::smooth && kv != Kind::smooth && !along) return p; // would join two places of a feature
    if (ku == Kind::corner && kv == Kind::corner) return p;
    p.keep_first = ku > kv, p.keep_second = kv > ku;
    const Vec3 edge = s.at[v] - s.at[u];
    const double squared = dot(edge, edge);
    if (p.keep_first) p.at = s.at[u];
    if (p.keep_second) p.at = s.at[v];
    const bool held = p.keep_first || p.keep_second;
    if (s.quadrics.empty()) {
        if (!held) p.at = mix(s.at[u], s.at[v], 0.5);
        p.cost = squared, p.error = squared / 4;
        return p;
    }
    const Quadric shape = s.quadrics[u] + s.quadrics[v];
    Quadric q = shape;
    if (s.fields.channels > 0) add_fields(q, s, corner, along);
    if (!held) choose_place(p, q, s.at[u], s.at[v], s.endpoints);
    const double root = std::sqrt(shape.weight), share = root * std::sqrt(root);
    p.cost = q(p.at) + shortness * shape.weight * squared;
    if (share > 0) p.cost /= share;
    p.error = shape.weight > 0 ? shape(p.at) / shape.weight : 0;
    return p;
}

} // namespace facetmill::simplification

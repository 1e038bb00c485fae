// What a collapse costs and where its vertex goes.

#include "base/parallel.hpp"
#include "geometry/simplify/work.hpp"

namespace facetmill::simplification {

namespace {

// Weights of the planes that stand on feature edges, per squared length of the edge, relative to faces per
// area.
constexpr double boundary_weight = 10, feature_weight = 1;
/// A of the quadric of a face, weighed by its area, at its corners.
struct FaceQuadric {
    float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

FaceQuadric quadric_of(const Work& s, Index f) {
    const Vec3& p = s.at[s.tri[3 * f]];
    const Vec3 n = cross(s.at[s.tri[3 * f + 1]] - p, s.at[s.tri[3 * f + 2]] - p); // twice the area long
    const double twice = length(n);
    if (!(twice > 0)) return {};
    const Vec3 w = n * (0.5 / twice);
    const auto f32 = [](double x) { return static_cast<float>(x); };
    return {f32(w.x * n.x), f32(w.x * n.y), f32(w.x * n.z), f32(w.y * n.y), f32(w.y * n.z), f32(w.z * n.z)};
}

/// Adds the plane through the edge of corner c, which is at the vertex, upright on its face.
void add_upright(Quadric& q, const Work& s, Index c) {
    if (!(s.flags[c] & feature_edge)) return;
    const Vec3& from = s.at[s.tri[c]];
    const Vec3 along = s.at[s.tri[after(c)]] - from;
    const Vec3 side = normalised(cross(along, cross(along, s.at[s.tri[before(c)]] - from)));
    const double weight = (s.flags[c] & boundary_edge ? boundary_weight : feature_weight) * dot(along, along);
    const Vec3 w = side * weight;
    q += {w.x * side.x, w.x * side.y, w.x * side.z, w.y * side.y, w.y * side.z, w.z * side.z, {}, 0, 0};
}

/// Of the planes through the vertex v, as seen from it.
Quadric quadric_at(const Work& s, Index v, const std::vector<FaceQuadric>& faces) {
    Quadric q;
    for (Index c = s.first[v]; c != none; c = s.next[c]) {
        const FaceQuadric& f = faces[c / 3];
        q.xx += f.xx, q.xy += f.xy, q.xz += f.xz, q.yy += f.yy, q.yz += f.yz, q.zz += f.zz;
        if (s.has_features) add_upright(q, s, c), add_upright(q, s, before(c));
    }
    return q;
}

/// Chooses where two ends that are both free to move should meet, as seen from the middle; half: from there
/// to the second end.
Vec3 choose_place(Placement& p, const Quadric& q, const Vec3& half, bool endpoints) {
    if (!endpoints) {
        const Vec3 best = q.weight > 0 ? q.least({}, pull * q.weight) : Vec3{};
        // Far off the edge the system was near singular: its ends and middle are safer.
        if (dot(best, best) <= most_off * dot(half, half)) return best;
    }
    const double at_a = q(-half), at_b = q(half), at_middle = q({});
    if (!endpoints && at_middle <= at_a && at_middle <= at_b) return {};
    (at_a <= at_b ? p.keep_first : p.keep_second) = true;
    return at_a <= at_b ? -half : half;
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

/// What the attributes at both ends pay, as seen from `from`; on a seam, those of both sides.
void add_fields(Quadric& q, const Work& s, Index corner, bool along, const Vec3& from) {
    const auto add = [&](Index a, Index b) {
        add_keeping_weight(q, seen_from(residual(s.fields, a, b), from));
    };
    if (s.wedge.empty()) return add(s.tri[corner], s.tri[after(corner)]);
    const Index a = s.wedge[corner], b = s.wedge[after(corner)];
    add(a, b);
    const Index other = along ? opposite(s, corner) : none;
    if (other == none) return;
    const Index x = s.wedge[after(other)], y = s.wedge[other];
    if (x != a || y != b) add(x, y);
}

} // namespace

void sum_quadrics(Work& s) {
    std::vector<FaceQuadric> faces(s.face_slots());
    parallel_for(faces.size(), [&](std::size_t f) { faces[f] = quadric_of(s, static_cast<Index>(f)); });
    s.quadrics.resize(s.vertex_slots());
    parallel_for(s.vertex_slots(), [&](std::size_t v) {
        s.quadrics[v] = rounded(quadric_at(s, static_cast<Index>(v), faces));
    });
}

namespace {

/// The planes of both ends of an edge and the attributes there, as seen from its middle.
struct Meeting {
    Index u, v;
    Vec3 half; ///< from the middle to v
    Quadric shape, all;

    Meeting(const Work& s, Index corner, std::uint8_t flags)
        : u(s.tri[corner]), v(s.tri[after(corner)]), half((s.at[v] - s.at[u]) * 0.5) {
        if (s.quadrics.empty()) return;
        shape = seen_from(s.quadrics[u], half) + seen_from(s.quadrics[v], -half);
        all = shape;
        if (s.fields.channels > 0) add_fields(all, s, corner, flags & feature_edge, s.at[u] + half);
    }

    /// Sets which end stays, and returns the place.
    Vec3 choose(const Work& s, Placement& p) const {
        const Kind ku = s.kind[u], kv = s.kind[v];
        p.keep_first = ku > kv, p.keep_second = kv > ku;
        if (p.keep_first) return -half;
        if (p.keep_second) return half;
        return s.quadrics.empty() ? Vec3{} : choose_place(p, all, half, s.endpoints);
    }
};

} // namespace

Placement place(const Work& s, Index corner, std::uint8_t flags) {
    const Meeting edge(s, corner, flags);
    Placement p;
    const Vec3 to = edge.choose(s, p);
    if (s.quadrics.empty())
        p.error = dot(edge.half, edge.half);
    else {
        p.error = edge.shape.weight > 0 ? edge.shape(to) / edge.shape.weight : 0;
        p.joined = rounded(seen_from(edge.shape, to));
    }
    p.at = p.keep_first ? s.at[edge.u] : p.keep_second ? s.at[edge.v] : s.at[edge.u] + edge.half + to;
    return p;
}

float cost_of(const Work& s, Index corner, std::uint8_t flags) {
    const Meeting edge(s, corner, flags);
    const double squared = 4 * dot(edge.half, edge.half);
    if (s.quadrics.empty()) return static_cast<float>(squared);
    Placement p;
    const double value = edge.all(edge.choose(s, p)), weight = edge.shape.weight;
    const double root = std::sqrt(weight), share = root * std::sqrt(root);
    return static_cast<float>(share > 0 ? (value + shortness * weight * squared) / share : value);
}

} // namespace facetmill::simplification

#include "geometry/simplify/cost.hpp"

#include "geometry/simplify/attributes.hpp"
#include "parallel/parallel.hpp"

#include <cstring>

namespace facetmill::simplification {

namespace {

// How strongly the new vertex is pulled to the middle of the edge, relative to the quadric's weight. It
// matters only if the planes leave the vertex free, in flat and straight regions. It exceeds the rounding
// error of the quadrics in single precision. With fine quadrics it is smaller, but planes that float32
// coordinates turn by about 1e-5 radians still count as coplanar.
constexpr double pull = 2e-7, fine_pull = 1e-10;
constexpr float pull_of_cost = 1e-6f;
// Short edges go first where errors are equal, as if each vertex were displaced by a thousandth of the edge.
// With fine quadrics the displacement is 1e-5 of the edge, the flatness error of a plane in float32
// coordinates.
constexpr float shortness = 1e-6f, fine_shortness = 1e-10f;
// An optimum is rejected if its squared distance from the edge's middle exceeds this multiple of the squared
// half length.
constexpr float max_off = 16;
// Edges are ordered by the sum of squared distances divided by area^(3/8). This is a compromise: the plain
// sum allows large errors on small parts. The mean spends faces on small parts, and allows large errors on
// narrow strips of long edges, such as fillets and bores. The area is capped at this multiple of the edge's
// squared length (5 in an even mesh). Otherwise large flat faces next to a boundary would make its edges
// cheap, depending on the positions of the faces' corners.
constexpr float reach = 12;

/// Chooses where two free ends should meet, relative to the middle. half: from the middle to the second end.
Vec3 choose_place(Placement& p, const Quadric& q, const Vec3& half, const State& s) {
    const bool endpoints = s.rules.endpoints;
    if (!endpoints) {
        const Vec3 best =
            q.weight > 0 ? q.least({}, (s.quadrics->fine ? fine_pull : pull) * q.weight) : Vec3{};
        // If the optimum is far from the edge, the system was nearly singular. The ends and the middle are
        // safer.
        if (dot(best, best) <= max_off * dot(half, half)) return best;
    }
    const double at_a = q(-half), at_b = q(half), at_middle = q({});
    if (!endpoints && at_middle <= at_a && at_middle <= at_b) return {};
    (at_a <= at_b ? p.keep_first : p.keep_second) = true;
    return at_a <= at_b ? -half : half;
}

/// Adds a quadric that is not a sum of planes, so the weight does not change.
void add_keeping_weight(Quadric& q, const Quadric& other) {
    const double weight = q.weight;
    q += other;
    q.weight = weight;
}

/// The corner of the same edge in the opposite direction, or none.
Index opposite(const State& s, Index corner) {
    const Index from = s.tri[after(corner)], to = s.tri[corner];
    for (Index c = s.rings.first[from]; c != none; c = s.rings.next[c])
        if (s.live(c / 3) && s.tri[after(c)] == to) return c;
    return none;
}

/// Adds the attribute errors of both ends, relative to `from`; on a seam, of both sides.
void add_attributes(Quadric& q, const State& s, Index corner, bool along, const Vec3& from) {
    const auto add = [&](Index a, Index b) {
        add_keeping_weight(q, seen_from(residual(*s.quadrics->attributes, a, b), from));
    };
    if (!s.has_seams()) return add(s.tri[corner], s.tri[after(corner)]);
    const Index a = s.wedge[corner], b = s.wedge[after(corner)];
    add(a, b);
    const Index other = along ? opposite(s, corner) : none;
    if (other == none) return;
    const Index x = s.wedge[after(other)], y = s.wedge[other];
    if (x != a || y != b) add(x, y);
}

/// The quadrics of both ends of an edge with their attributes, relative to the edge's middle.
struct Meeting {
    Index u, v;
    Vec3 half; ///< vector from the middle to v
    Quadric shape, all;

    Meeting(const State& s, Index corner, std::uint8_t flags)
        : u(s.tri[corner]), v(s.tri[after(corner)]), half((s.at[v] - s.at[u]) * 0.5) {
        if (!s.quadrics) return;
        const auto& [near, fine, attributes] = *s.quadrics;
        shape = fine ? seen_from((*fine)[u], half) + seen_from((*fine)[v], -half)
                     : seen_from(near[u], half) + seen_from(near[v], -half);
        all = shape;
        if (attributes) add_attributes(all, s, corner, flags & feature_edge, s.at[u] + half);
    }

    /// Chooses the position, and sets which end stays.
    Vec3 choose(const State& s, Placement& p) const {
        const Kind ku = s.features->kind[u], kv = s.features->kind[v];
        p.keep_first = ku > kv;
        p.keep_second = kv > ku;
        if (p.keep_first) return -half;
        if (p.keep_second) return half;
        return s.quadrics ? choose_place(p, all, half, s) : Vec3{};
    }
};

// Computes four costs at a time: like cost_of, in single precision.

using Four = float __attribute__((vector_size(16)));
using Mask = std::int32_t __attribute__((vector_size(16)));

Four load(const float* at) {
    Four x;
    std::memcpy(&x, at, sizeof x);
    return x;
}

/// Transposes a 4x4 matrix.
void transpose(Four& a, Four& b, Four& c, Four& d) {
    const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Four xy = __builtin_shufflevector(a, b, 2, 6, 3, 7), zw = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    c = __builtin_shufflevector(xy, zw, 0, 1, 4, 5);
    d = __builtin_shufflevector(xy, zw, 2, 3, 6, 7);
}

struct Vec3s {
    Four x, y, z;
};

Four dot(const Vec3s& a, const Vec3s& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Four quadrics.
struct Quadrics {
    Four xx, xy, xz, yy, yz, zz;
    Vec3s b;
    Four c;

    Vec3s times(const Vec3s& y) const {
        return {xx * y.x + xy * y.y + xz * y.z, xy * y.x + yy * y.y + yz * y.z,
                xz * y.x + yz * y.y + zz * y.z};
    }
    Four operator()(const Vec3s& y) const {
        const Vec3s ay = times(y);
        return dot(y, {ay.x - b.x - b.x, ay.y - b.y - b.y, ay.z - b.z - b.z}) + c;
    }
    /// See Quadric::least, with the anchor at 0; A's trace is 1.
    Vec3s least() const {
        const Four i0 = 1 / (xx + pull_of_cost), l10 = xy * i0, l20 = xz * i0;
        const Four i1 = 1 / (yy + pull_of_cost - l10 * xy), e21 = yz - l20 * xy, l21 = e21 * i1;
        const Four i2 = 1 / (zz + pull_of_cost - l20 * xz - l21 * e21);
        const Four y1 = b.y - l10 * b.x, y2 = b.z - l20 * b.x - l21 * y1;
        const Four z = y2 * i2, y = y1 * i1 - l21 * z;
        return {b.x * i0 - l10 * y - l20 * z, y, z};
    }
};

Quadrics quadrics_of(const std::vector<NearQuadric>& quadrics, Index p, Index q, Index r, Index t) {
    static_assert(sizeof(NearQuadric) == 10 * sizeof(float));
    const float* at[]{&quadrics[p].xx, &quadrics[q].xx, &quadrics[r].xx, &quadrics[t].xx};
    Quadrics all;
    all.xx = load(at[0]);
    all.xy = load(at[1]);
    all.xz = load(at[2]);
    all.yy = load(at[3]);
    transpose(all.xx, all.xy, all.xz, all.yy);
    Four a = load(at[0] + 4), b = load(at[1] + 4), c = load(at[2] + 4), d = load(at[3] + 4);
    transpose(a, b, c, d);
    all.yz = a;
    all.zz = b;
    all.b = {load(at[0] + 6), load(at[1] + 6), load(at[2] + 6)};
    all.c = load(at[3] + 6);
    transpose(all.b.x, all.b.y, all.b.z, all.c);
    return all;
}

/// The sum of both ends' quadrics, relative to the middles of the edges. half: from the middles to the second
/// ends.
Quadrics joined(const Quadrics& p, const Quadrics& q, const Vec3s& half) {
    const Quadrics less{q.xx - p.xx, q.xy - p.xy, q.xz - p.xz, q.yy - p.yy, q.yz - p.yz, q.zz - p.zz, {}, {}};
    Quadrics sum{p.xx + q.xx, p.xy + q.xy, p.xz + q.xz, p.yy + q.yy, p.yz + q.yz, p.zz + q.zz, {}, {}};
    const Vec3s off = less.times(half), ah = sum.times(half);
    const Vec3s difference{p.b.x - q.b.x, p.b.y - q.b.y, p.b.z - q.b.z};
    sum.b = {p.b.x + q.b.x + off.x, p.b.y + q.b.y + off.y, p.b.z + q.b.z + off.z};
    sum.c = p.c + q.c +
            dot(half, {ah.x - difference.x - difference.x, ah.y - difference.y - difference.y,
                       ah.z - difference.z - difference.z});
    return sum;
}

/// Scales the quadrics so that A's trace is 1; returns the old trace.
Four normalise(Quadrics& q) {
    const Four weight = q.xx + q.yy + q.zz;
    const Four share = weight > 0 ? 1 / weight : Four{};
    for (Four* x : {&q.xx, &q.xy, &q.xz, &q.yy, &q.yz, &q.zz, &q.b.x, &q.b.y, &q.b.z, &q.c}) *x *= share;
    return weight;
}

Four root(Four x) {
    for (int i = 0; i < 4; ++i) x[i] = std::sqrt(x[i]);
    return x;
}

Four larger(Four x, Four y) { return x > y ? x : y; }
Four smaller(Four x, Four y) { return x < y ? x : y; }

/// The costs of four edges. unsure: the costs too small for single precision.
Four costs_of(const State& s, const PricedEdge* e, Mask& unsure) {
    Vec3s half;
    Mask held;
    for (int i = 0; i < 4; ++i) {
        const Vec3 d = (s.at[e[i].v] - s.at[e[i].u]) * 0.5;
        half.x[i] = static_cast<float>(d.x);
        half.y[i] = static_cast<float>(d.y);
        half.z[i] = static_cast<float>(d.z);
        held[i] = static_cast<std::int32_t>(e[i].held);
    }
    Quadrics q = joined(quadrics_of(s.quadrics->near, e[0].u, e[1].u, e[2].u, e[3].u),
                        quadrics_of(s.quadrics->near, e[0].v, e[1].v, e[2].v, e[3].v), half);
    const Four weight = normalise(q);
    const Four quarter = dot(half, half);
    const Four at_first = q({-half.x, -half.y, -half.z}), at_second = q(half);
    const Four at_end = at_first < at_second ? at_first : at_second;
    Four value = at_end;
    if (!s.rules.endpoints) {
        const Vec3s best = q.least();
        value = dot(best, best) <= quarter * max_off ? q(best) : (q.c < at_end ? q.c : at_end);
    }
    value = held == 1 ? at_first : held == 2 ? at_second : value;
    unsure = value < quarter * static_cast<float>(4 * doubtful);
    const Four sum =
        (larger(value, Four{}) + quarter * (4 * (s.quadrics->fine ? fine_shortness : shortness))) * weight;
    const Four fourth = root(root(smaller(weight, quarter * (4 * reach))));
    return fourth > 0 ? sum / (fourth * root(fourth)) : sum;
}

} // namespace

Placement place(const State& s, Index corner, std::uint8_t flags) {
    const Meeting edge(s, corner, flags);
    Placement p;
    const Vec3 to = edge.choose(s, p);
    if (s.quadrics) {
        p.error = edge.shape.weight > 0 ? edge.shape(to) / edge.shape.weight : 0;
        p.joined = seen_from(edge.shape, to);
    } else {
        p.error = dot(edge.half, edge.half);
    }
    p.at = p.keep_first ? s.at[edge.u] : p.keep_second ? s.at[edge.v] : s.at[edge.u] + edge.half + to;
    return p;
}

float cost_of(const State& s, Index corner, std::uint8_t flags) {
    const Meeting edge(s, corner, flags);
    const double squared = 4 * dot(edge.half, edge.half);
    if (!s.quadrics) return static_cast<float>(squared);
    Placement p;
    const double value = edge.all(edge.choose(s, p)), weight = edge.shape.weight;
    const double fourth = std::sqrt(std::sqrt(std::min(weight, reach * squared))),
                 share = fourth * std::sqrt(fourth);
    return static_cast<float>(
        share > 0 ? (value + (s.quadrics->fine ? fine_shortness : shortness) * weight * squared) / share
                  : value);
}

void Pricer::finish() {
    if (count_ == 0) return;
    for (std::size_t i = count_; i < 4; ++i) waiting_[i] = waiting_[0];
    Mask unsure;
    const Four cost = costs_of(s_, waiting_.data(), unsure);
    for (std::size_t i = 0; i < count_; ++i) {
        const Index corner = waiting_[i].corner;
        const auto at = static_cast<int>(i);
        set(corner, s_.quadrics->fine && unsure[at] ? cost_of(s_, corner, s_.edges.flags[corner]) : cost[at]);
    }
    count_ = 0;
}

void price_all(State& s) {
    parallel_chunks(
        s.face_slots(),
        [&](std::size_t begin, std::size_t end) {
            Pricer pricer(s);
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                if (!s.live(f)) continue;
                const Index c = 3 * f, x = s.tri[c], y = s.tri[c + 1], z = s.tri[c + 2];
                pricer(c, x, y);
                pricer(c + 1, y, z);
                pricer(c + 2, z, x);
            }
            pricer.finish();
        },
        4096);
}

} // namespace facetmill::simplification

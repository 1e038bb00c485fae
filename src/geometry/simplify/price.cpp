// The costs of edges, four at a time: what place (simplify_cost.cpp) says, in single precision.

#include "geometry/simplify/price.hpp"
#include "base/parallel.hpp"

#include <cstring>

namespace facetmill::simplification {

namespace {

using Four = float __attribute__((vector_size(16)));
using Mask = std::int32_t __attribute__((vector_size(16)));

Four load(const float* at) {
    Four x;
    std::memcpy(&x, at, sizeof x);
    return x;
}

/// Four rows of four become four columns.
void transpose(Four& a, Four& b, Four& c, Four& d) {
    const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Four xy = __builtin_shufflevector(a, b, 2, 6, 3, 7), zw = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab, cd, 0, 1, 4, 5), b = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    c = __builtin_shufflevector(xy, zw, 0, 1, 4, 5), d = __builtin_shufflevector(xy, zw, 2, 3, 6, 7);
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

Quadrics quadrics_of(const Work& s, Index p, Index q, Index r, Index t) {
    static_assert(sizeof(NearQuadric) == 10 * sizeof(float));
    const float* at[]{&s.quadrics[p].xx, &s.quadrics[q].xx, &s.quadrics[r].xx, &s.quadrics[t].xx};
    Quadrics all;
    all.xx = load(at[0]), all.xy = load(at[1]), all.xz = load(at[2]), all.yy = load(at[3]);
    transpose(all.xx, all.xy, all.xz, all.yy);
    Four a = load(at[0] + 4), b = load(at[1] + 4), c = load(at[2] + 4), d = load(at[3] + 4);
    transpose(a, b, c, d);
    all.yz = a, all.zz = b;
    all.b.x = load(at[0] + 6), all.b.y = load(at[1] + 6), all.b.z = load(at[2] + 6), all.c = load(at[3] + 6);
    transpose(all.b.x, all.b.y, all.b.z, all.c);
    return all;
}

/// The sum of both ends' quadrics as seen from the middles of the edges; half: from there to the second ends.
Quadrics joined(const Quadrics& p, const Quadrics& q, const Vec3s& half) {
    const Quadrics less{q.xx - p.xx, q.xy - p.xy, q.xz - p.xz, q.yy - p.yy, q.yz - p.yz, q.zz - p.zz, {}, {}};
    Quadrics sum{p.xx + q.xx, p.xy + q.xy, p.xz + q.xz, p.yy + q.yy, p.yz + q.yz, p.zz + q.zz, {}, {}};
    const Vec3s off = less.times(half), ah = sum.times(half);
    const Vec3s apart{p.b.x - q.b.x, p.b.y - q.b.y, p.b.z - q.b.z};
    sum.b = {p.b.x + q.b.x + off.x, p.b.y + q.b.y + off.y, p.b.z + q.b.z + off.z};
    sum.c =
        p.c + q.c + dot(half, {ah.x - apart.x - apart.x, ah.y - apart.y - apart.y, ah.z - apart.z - apart.z});
    return sum;
}

/// Scaled so that A's trace is 1; returns what it was.
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

/// The costs of four edges.
Four costs_of(const Work& s, const PricedEdge* e) {
    Vec3s half;
    Mask held;
    for (int i = 0; i < 4; ++i) {
        const Vec3 d = (s.at[e[i].v] - s.at[e[i].u]) * 0.5;
        half.x[i] = static_cast<float>(d.x), half.y[i] = static_cast<float>(d.y);
        half.z[i] = static_cast<float>(d.z);
        held[i] = static_cast<std::int32_t>(e[i].held);
    }
    Quadrics q = joined(quadrics_of(s, e[0].u, e[1].u, e[2].u, e[3].u),
                        quadrics_of(s, e[0].v, e[1].v, e[2].v, e[3].v), half);
    const Four weight = normalise(q);
    const Four quarter = dot(half, half);
    const Four at_first = q({-half.x, -half.y, -half.z}), at_second = q(half);
    const Four at_end = at_first < at_second ? at_first : at_second;
    Four value = at_end;
    if (!s.endpoints) {
        const Vec3s best = q.least();
        value = dot(best, best) <= quarter * most_off ? q(best) : (q.c < at_end ? q.c : at_end);
    }
    value = held == 1 ? at_first : held == 2 ? at_second : value;
    return (larger(value, Four{}) + quarter * (4 * shortness)) * root(root(weight));
}

} // namespace

void Pricer::finish() {
    if (count_ == 0) return;
    for (std::size_t i = count_; i < 4; ++i) waiting_[i] = waiting_[0];
    const Four cost = costs_of(s_, waiting_.data());
    for (std::size_t i = 0; i < count_; ++i) set(waiting_[i].corner, cost[static_cast<int>(i)]);
    count_ = 0;
}

void price_all(Work& s) {
    parallel_chunks(
        s.face_slots(),
        [&](std::size_t begin, std::size_t end) {
            Pricer pricer(s);
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                if (!s.live(f)) continue;
                const Index c = 3 * f, x = s.tri[c], y = s.tri[c + 1], z = s.tri[c + 2];
                pricer(c, x, y), pricer(c + 1, y, z), pricer(c + 2, z, x);
            }
            pricer.finish();
        },
        4096);
}

} // namespace facetmill::simplification

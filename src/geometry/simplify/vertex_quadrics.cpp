// The initial quadrics of vertices. They contain the planes of the faces, and planes perpendicular to faces
// that hold boundaries, features and sharp folds.

#include "geometry/simplify/cost.hpp"
#include "parallel/parallel.hpp"

namespace facetmill::simplification {

namespace {

// Weights of the perpendicular planes, per squared edge length, relative to faces per area.
constexpr double boundary_weight = 10, feature_weight = 1;
// The edges of a sample of about this many faces decide whether fine quadrics are worth their time.
constexpr std::size_t flat_sample = 1 << 12;
constexpr double flat_share = 1.0 / 16; // share of the sampled edges
// Squared errors below this share of an edge's squared length are lost in the rounding of single precision.
constexpr double invisible = 1e-7;

/// The normal of a face, with the square root of its area as length; 0 for a flat face, whose normal is
/// undefined.
Vec3 root_normal(const State& s, Index f) {
    const Vec3 &p = s.at[s.tri[3 * f]], &q = s.at[s.tri[3 * f + 1]], &r = s.at[s.tri[3 * f + 2]];
    const Vec3 n = cross(q - p, r - p); // a vector whose length is twice the area
    const double twice = length(n);
    const double longest = std::max({dot(q - p, q - p), dot(r - q, r - q), dot(p - r, p - r)});
    return twice > least_height * longest ? n / std::sqrt(2 * twice) : Vec3{};
}

/// Adds the plane of a face.
void add_plane(Quadric& q, const Vec3& w) {
    q.xx += w.x * w.x;
    q.xy += w.x * w.y;
    q.xz += w.x * w.z;
    q.yy += w.y * w.y;
    q.yz += w.y * w.z;
    q.zz += w.z * w.z;
}

/// Adds the plane through the edge of corner c that is perpendicular to its face. The vertex is on the edge.
/// weight: per squared length of the edge.
void add_upright(Quadric& q, const State& s, Index c, double weight) {
    const Vec3& from = s.at[s.tri[c]];
    const Vec3 along = s.at[s.tri[after(c)]] - from;
    const Vec3 side = normalised(cross(along, cross(along, s.at[s.tri[before(c)]] - from)));
    add_plane(q, side * std::sqrt(weight * dot(along, along)));
}

void add_feature(Quadric& q, const State& s, Index c) {
    if (s.edges.flags[c] & feature_edge)
        add_upright(q, s, c, s.edges.flags[c] & boundary_edge ? boundary_weight : feature_weight);
}

/// True if the face may form an angle of more than 90 degrees with another face. If all normals are within 45
/// degrees of a common direction, no pair does.
bool may_fold(const Vec3& w, const Vec3& mean) {
    const double along = dot(w, mean), size = dot(w, w);
    return size > 0 && !(along > 0 && 2 * along * along >= size * dot(mean, mean));
}

/// A face at a vertex: it runs from the neighbour `in` through the vertex to the neighbour `out`.
struct FoldCorner {
    Index in, out, corner;
};

/// The next face at the edge to `out`, skipping faces without area; none at a boundary.
const FoldCorner* next_with_area(const std::vector<FoldCorner>& corners, Index out,
                                 const std::vector<Vec3>& normals) {
    for (std::size_t steps = 0; steps < corners.size(); ++steps) {
        const auto at = std::lower_bound(corners.begin(), corners.end(), out,
                                         [](const FoldCorner& k, Index in) { return k.in < in; });
        if (at == corners.end() || at->in != out) return nullptr;
        const Vec3& w = normals[at->corner / 3];
        if (dot(w, w) > 0) return &*at;
        out = at->out;
    }
    return nullptr;
}

/// If neighbouring faces at v fold back on each other, their planes barely hold the fold (not at all at a
/// full turn), although the surface ends at it. The fold is then held like the boundary of a sheet. The
/// weight compensates for the missing constraint: the cosine of the angle between the faces.
void add_folds(Quadric& q, const State& s, Index v, const std::vector<Vec3>& normals) {
    std::vector<FoldCorner> corners;
    for (Index c = s.rings.first[v]; c != none; c = s.rings.next[c])
        corners.push_back({s.tri[before(c)], s.tri[after(c)], c});
    std::sort(corners.begin(), corners.end(), [](const FoldCorner& a, const FoldCorner& b) {
        return a.in != b.in ? a.in < b.in : a.corner < b.corner;
    });
    for (const FoldCorner& k : corners) {
        const Vec3& w = normals[k.corner / 3];
        const double size = dot(w, w);
        if (!(size > 0)) continue;
        const FoldCorner* then = next_with_area(corners, k.out, normals);
        if (!then) continue;
        const Vec3& other = normals[then->corner / 3];
        const double turn = dot(w, other);
        if (turn >= 0) continue;
        const double weight = boundary_weight / 2 * -turn / std::sqrt(size * dot(other, other));
        add_upright(q, s, k.corner, weight);
        add_upright(q, s, before(then->corner), weight);
    }
}

/// The quadric of the planes through vertex v, relative to v.
Quadric quadric_at(const State& s, Index v, const std::vector<Vec3>& normals) {
    std::array<Vec3, 12> few; // nearly all vertices have no more faces
    std::size_t size = 0;
    Quadric q;
    Vec3 mean;
    for (Index c = s.rings.first[v]; c != none; c = s.rings.next[c]) {
        const Vec3& w = normals[c / 3];
        if (size < few.size()) few[size] = w;
        ++size;
        add_plane(q, w);
        mean += w;
        if (!s.features || !s.features->any) continue;
        add_feature(q, s, c);
        add_feature(q, s, before(c));
    }
    bool folds = size > few.size();
    for (std::size_t i = 0; i < size && !folds; ++i) folds = may_fold(few[i], mean);
    if (folds) add_folds(q, s, v, normals);
    return q;
}

template <class Real>
std::vector<QuadricAbout<Real>> all_quadrics(const State& s) {
    std::vector<Vec3> normals;
    resize_large(normals, s.face_slots());
    parallel_for(normals.size(), [&](std::size_t f) { normals[f] = root_normal(s, static_cast<Index>(f)); });
    std::vector<QuadricAbout<Real>> quadrics;
    resize_large(quadrics, s.vertex_slots());
    parallel_for(quadrics.size(), [&](std::size_t v) {
        quadrics[v] = rounded<Real>(quadric_at(s, static_cast<Index>(v), normals));
    });
    return quadrics;
}

/// True if a large share of the edges have errors too small for single precision.
bool is_mostly_flat(const State& s) {
    struct Count {
        std::size_t flat = 0, all = 0;
    };
    const std::size_t stride = s.face_slots() / flat_sample + 1;
    const auto look = [&](Index c, Count& count) {
        if (!may_go(s.features->kind[s.tri[c]], s.features->kind[s.tri[after(c)]], s.edges.flags[c])) return;
        const Vec3 along = s.at[s.tri[after(c)]] - s.at[s.tri[c]];
        ++count.all;
        count.flat += place(s, c, s.edges.flags[c]).error < invisible * dot(along, along);
    };
    const Count found = parallel_reduce(
        s.face_slots() / stride, Count{},
        [&](std::size_t begin, std::size_t end) {
            Count count;
            for (std::size_t i = begin; i < end; ++i)
                for (Index k = 0; k < 3; ++k) look(static_cast<Index>(3 * i * stride) + k, count);
            return count;
        },
        [](Count a, const Count& b) {
            a.flat += b.flat;
            a.all += b.all;
            return a;
        });
    return static_cast<double>(found.flat) > flat_share * static_cast<double>(found.all);
}

} // namespace

std::vector<NearQuadric> vertex_quadrics(const State& s) { return all_quadrics<float>(s); }

void set_quadrics(State& s) {
    s.quadrics = {.near = vertex_quadrics(s), .fine = {}, .attributes = {}};
    if (is_mostly_flat(s)) s.quadrics->fine = all_quadrics<double>(s);
}

} // namespace facetmill::simplification

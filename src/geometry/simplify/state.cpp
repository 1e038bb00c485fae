#include "geometry/simplify/state.hpp"

#include "parallel/parallel.hpp"
#include "parallel/storage.hpp"

#include <atomic>
#include <bit>

namespace facetmill::simplification {

namespace {

/// Spreads the lowest 11 bits of x, with two zeros between neighbours.
std::uint64_t spread(std::uint64_t x) {
    x = (x | (x << 16)) & 0x00ff0000ff0000ff;
    x = (x | (x << 8)) & 0xf00f00f00f00f00f;
    x = (x | (x << 4)) & 0x30c30c30c30c30c3;
    return (x | (x << 2)) & 0x9249249249249249;
}

struct Keyed {
    std::uint32_t key;
    Index item;
};

/// The used vertices in the order of the Morton curve.
std::vector<Keyed> ordered_vertices(const Mesh& mesh, const UsedVertices& used, const Frame& frame) {
    std::vector<Keyed> order;
    reserve_large(order, used.count);
    for (std::size_t v = 0; v < used.flags.size(); ++v)
        if (used.flags[v]) order.push_back({0, static_cast<Index>(v)});
    parallel_for(order.size(), [&](std::size_t i) {
        const Vec3 p = frame.inside(mesh.positions[order[i].item]);
        const auto cell = [](double x) {
            return spread(static_cast<std::uint64_t>(std::clamp((x + 1) * 1024, 0.0, 2047.0)));
        };
        const std::uint64_t code = cell(p.x) | (cell(p.y) << 1) | (cell(p.z) << 2); // a code of 33 bits
        order[i].key = static_cast<std::uint32_t>(code >> 1);
    });
    radix_sort(
        order, [](const Keyed& k) { return k.key; }, 32);
    return order;
}

/// The faces, in the order of their first vertex on the curve.
std::vector<Keyed> ordered_faces(const Mesh& mesh, const std::vector<Index>& rank, std::size_t vertices) {
    std::vector<Keyed> order;
    resize_large(order, mesh.face_count());
    parallel_for(order.size(), [&](std::size_t i) {
        const auto f = static_cast<Index>(i);
        const Index lowest =
            std::min({rank[mesh.vertex(3 * f)], rank[mesh.vertex(3 * f + 1)], rank[mesh.vertex(3 * f + 2)]});
        order[i] = {lowest, f};
    });
    radix_sort(
        order, [](const Keyed& k) { return k.key; }, std::bit_width(vertices));
    return order;
}

/// The frame with the centre of the bounding box, and the power of two that brings the mesh into [-1, 1].
Frame frame_of(const Mesh& mesh) {
    const Box box = mesh.bounds();
    if (box.empty()) return {};
    const Vec3 half = box.max * 0.5 - box.min * 0.5;
    int exponent = 0;
    std::frexp(std::max({half.x, half.y, half.z}), &exponent);
    // Halving the sum of the corners could overflow instead.
    return {box.min * 0.5 + box.max * 0.5, std::ldexp(1.0, std::clamp(-exponent, -1000, 1000))};
}

/// Builds the lists of corners per vertex from tri.
void build_lists(State& s) {
    // Serial: in curve order this takes a few milliseconds per million faces, less than sorting.
    s.rings.first.assign(s.vertex_slots(), none);
    resize_large(s.rings.next, s.tri.size());
    for (std::size_t c = s.tri.size(); c-- > 0;)
        s.rings.next[c] = std::exchange(s.rings.first[s.tri[c]], static_cast<Index>(c));
}

/// Keeps the listed items in their order; an empty array stays empty. per: values of one item.
template <class T>
void keep(std::vector<T>& items, const std::vector<Index>& kept, std::size_t per = 1) {
    if (items.empty()) return;
    std::vector<T> left(kept.size() * per);
    parallel_for(kept.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < per; ++k) left[per * i + k] = items[per * kept[i] + k];
    });
    items.swap(left);
}

/// Keeps the listed vertices, and renumbers the vertices of faces.
void keep_vertices(Shape& s, const std::vector<Index>& kept) {
    std::vector<Index> rank(s.vertex_slots(), none);
    for (std::size_t i = 0; i < kept.size(); ++i) rank[kept[i]] = static_cast<Index>(i);
    parallel_for(s.tri.size(), [&](std::size_t c) { s.tri[c] = rank[s.tri[c]]; });
    keep(s.at, kept);
    keep(s.moved, kept);
    keep(s.source, kept);
}

void keep_vertices(QuadricCost& cost, bool seams, const std::vector<Index>& kept) {
    keep(cost.near, kept);
    if (cost.fine) keep(*cost.fine, kept);
    if (!cost.attributes || seams) return; // wedge attributes do not change
    keep(cost.attributes->squares, kept);
    keep(cost.attributes->sums, kept, 4 * cost.attributes->channels);
}

void keep_faces(State& s, const std::vector<Index>& kept) {
    keep(s.tri, kept, 3);
    keep(s.wedge, kept, 3);
    keep(s.edges.flags, kept, 3);
    keep(s.edges.cost, kept, 3);
    keep(s.face_source, kept);
    if (s.bounds.followed) keep(s.bounds.followed->first, kept);
}

} // namespace

UsedVertices::UsedVertices(const Mesh& mesh) : flags(mesh.vertex_count()) {
    parallel_for(mesh.corner_count(), [&](std::size_t c) {
        std::atomic_ref(flags[mesh.vertex(static_cast<Index>(c))]).store(1, std::memory_order_relaxed);
    });
    count = static_cast<std::size_t>(std::count(flags.begin(), flags.end(), 1));
}

State lay_out(const Mesh& mesh, const UsedVertices& used) {
    State s;
    s.frame = frame_of(mesh);
    const std::vector<Keyed> order = ordered_vertices(mesh, used, s.frame);
    const std::size_t n = order.size(), m = mesh.face_count();
    std::vector<Index> rank(mesh.vertex_count(), none);
    resize_large(s.at, n);
    resize_large(s.source, n);
    parallel_for(n, [&](std::size_t i) {
        s.source[i] = order[i].item;
        rank[order[i].item] = static_cast<Index>(i);
        s.at[i] = s.frame.inside(mesh.positions[order[i].item]);
    });
    s.moved.resize(n);
    s.order.touched.resize(n);
    s.order.dirty.resize(n);
    const std::vector<Keyed> faces = ordered_faces(mesh, rank, n);
    resize_large(s.tri, 3 * m);
    resize_large(s.edges.flags, 3 * m);
    resize_large(s.face_source, m);
    if (mesh.has_seams()) s.wedge.resize(3 * m);
    parallel_for(m, [&](std::size_t i) {
        s.face_source[i] = faces[i].item;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index c = 3 * faces[i].item + static_cast<Index>(k);
            s.tri[3 * i + k] = rank[mesh.vertex(c)];
            if (mesh.has_seams()) s.wedge[3 * i + k] = mesh.corners[c];
        }
    });
    s.rings.live_faces = m;
    s.rings.live_vertices = n;
    build_lists(s);
    return s;
}

void compact(State& s) {
    std::vector<Index> faces, vertices;
    faces.reserve(s.rings.live_faces);
    vertices.reserve(s.rings.live_vertices);
    for (Index f = 0; f < s.face_slots(); ++f)
        if (s.live(f)) faces.push_back(f);
    // A vertex that was merged, or lost its last face, has no list.
    for (Index v = 0; v < s.vertex_slots(); ++v)
        if (s.rings.first[v] != none) vertices.push_back(v);
    keep_faces(s, faces);
    keep_vertices(s, vertices);
    if (s.features) keep(s.features->kind, vertices);
    keep(s.order.touched, vertices);
    keep(s.order.dirty, vertices);
    if (s.quadrics) keep_vertices(*s.quadrics, s.has_seams(), vertices);
    if (s.bounds.limits) keep(*s.bounds.limits, vertices);
    build_lists(s);
}

void drop_unused(Shape& s) {
    std::vector<std::uint8_t> used(s.vertex_slots());
    for (const Index v : s.tri) used[v] = 1;
    std::vector<Index> kept;
    for (Index v = 0; v < used.size(); ++v)
        if (used[v]) kept.push_back(v);
    keep_vertices(s, kept);
}

} // namespace facetmill::simplification

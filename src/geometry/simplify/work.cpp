#include "geometry/simplify/work.hpp"

#include "base/parallel.hpp"
#include "base/storage.hpp"

#include <atomic>
#include <bit>

namespace facetmill::simplification {

namespace {

/// The lowest 11 bits of x, two zeros between neighbours.
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

/// Vertices that faces use, along the curve.
std::vector<Keyed> ordered_vertices(const Mesh& mesh, const Work& s) {
    std::vector<std::uint8_t> used(mesh.vertex_count());
    parallel_for(mesh.corner_count(), [&](std::size_t c) {
        std::atomic_ref(used[mesh.vertex(static_cast<Index>(c))]).store(1, std::memory_order_relaxed);
    });
    std::vector<Keyed> order;
    order.reserve(mesh.vertex_count());
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) order.push_back({0, static_cast<Index>(v)});
    parallel_for(order.size(), [&](std::size_t i) {
        // Coordinates are within [-1, 1] by the choice of centre and scale.
        const Vec3 p = (mesh.positions[order[i].item] - s.centre) * s.scale;
        const auto cell = [](double x) {
            return spread(static_cast<std::uint64_t>(std::clamp((x + 1) * 1024, 0.0, 2047.0)));
        };
        const std::uint64_t code = cell(p.x) | (cell(p.y) << 1) | (cell(p.z) << 2); // 33 bits
        order[i].key = static_cast<std::uint32_t>(code >> 1);
    });
    radix_sort(
        order, [](const Keyed& k) { return k.key; }, 32);
    return order;
}

/// Faces by their first vertex along the curve.
std::vector<Keyed> ordered_faces(const Mesh& mesh, const std::vector<Index>& rank, std::size_t vertices) {
    std::vector<Keyed> order(mesh.face_count());
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

/// Centre of the bounds and the power of two that brings the mesh into [-1, 1].
void set_frame(Work& s, const Mesh& mesh) {
    const Box box = mesh.bounds();
    if (box.empty()) return;
    s.centre = box.min * 0.5 + box.max * 0.5; // not the sum halved, which may overflow
    const Vec3 half = box.max * 0.5 - box.min * 0.5;
    int exponent = 0;
    std::frexp(std::max({half.x, half.y, half.z}), &exponent);
    s.scale = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
}

/// The items of those that live, in order.
template <class T>
void keep(std::vector<T>& items, const std::vector<Index>& alive, std::size_t per = 1) {
    if (items.empty()) return;
    std::vector<T> kept(alive.size() * per);
    parallel_for(alive.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < per; ++k) kept[per * i + k] = items[per * alive[i] + k];
    });
    items.swap(kept);
}

} // namespace

Work build_work(const Mesh& mesh) {
    Work s;
    set_frame(s, mesh);
    const std::vector<Keyed> order = ordered_vertices(mesh, s);
    const std::size_t n = order.size(), m = mesh.face_count();
    std::vector<Index> rank(mesh.vertex_count(), none);
    resize_large(s.at, n), resize_large(s.source, n);
    parallel_for(n, [&](std::size_t i) {
        s.source[i] = order[i].item;
        rank[order[i].item] = static_cast<Index>(i);
        s.at[i] = (mesh.positions[order[i].item] - s.centre) * s.scale;
    });
    s.moved.resize(n), s.touched.resize(n), s.dirty.resize(n);
    const std::vector<Keyed> faces = ordered_faces(mesh, rank, n);
    resize_large(s.tri, 3 * m), resize_large(s.flags, 3 * m), resize_large(s.face_source, m);
    resize_large(s.cost, 3 * m, never);
    if (mesh.has_seams()) s.wedge.resize(3 * m);
    parallel_for(m, [&](std::size_t i) {
        s.face_source[i] = faces[i].item;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index c = 3 * faces[i].item + static_cast<Index>(k);
            s.tri[3 * i + k] = rank[mesh.vertex(c)];
            if (mesh.has_seams()) s.wedge[3 * i + k] = mesh.corners[c];
        }
    });
    s.live_faces = m, s.live_vertices = n;
    build_lists(s);
    return s;
}

void build_lists(Work& s) {
    // Serial: along the curve this is a few milliseconds per million faces, less than sorting would take.
    s.first.assign(s.vertex_slots(), none);
    resize_large(s.next, s.tri.size());
    for (std::size_t c = s.tri.size(); c-- > 0;)
        s.next[c] = std::exchange(s.first[s.tri[c]], static_cast<Index>(c));
}

void compact(Work& s) {
    std::vector<Index> faces, vertices, rank(s.vertex_slots(), none);
    faces.reserve(s.live_faces), vertices.reserve(s.live_vertices);
    for (Index f = 0; f < s.face_slots(); ++f)
        if (s.live(f)) faces.push_back(f);
    // A vertex that was collapsed, or lost its last face, has no list.
    for (Index v = 0; v < s.vertex_slots(); ++v)
        if (s.first[v] != none) rank[v] = static_cast<Index>(vertices.size()), vertices.push_back(v);
    keep(s.tri, faces, 3), keep(s.wedge, faces, 3), keep(s.flags, faces, 3), keep(s.cost, faces, 3);
    keep(s.face_source, faces), keep(s.first_point, faces);
    parallel_for(s.tri.size(), [&](std::size_t c) { s.tri[c] = rank[s.tri[c]]; });
    keep(s.at, vertices), keep(s.quadrics, vertices), keep(s.kind, vertices), keep(s.moved, vertices);
    if (s.wedge.empty())
        keep(s.fields.squares, vertices), keep(s.fields.sums, vertices, 4 * s.fields.channels);
    keep(s.source, vertices), keep(s.touched, vertices), keep(s.dirty, vertices);
    keep(s.limit, vertices);
    build_lists(s);
}

} // namespace facetmill::simplification

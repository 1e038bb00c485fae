// Vertices and wedges that go: the unused, and those at the same place.
#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/random.hpp"
#include "mesh/lineage.hpp"

#include <algorithm>
#include <bit>

namespace facetmill {

namespace {

/// What stays of the elements of a domain: the old index of each that stays, and the new index of each old
/// one.
struct Survivors {
    std::vector<Index> old, renumbered;
};

/// flags: 1 for the elements that stay.
Survivors survivors(std::vector<Index> flags) {
    Survivors s;
    const std::size_t n = flags.size();
    s.renumbered = std::move(flags);
    const Index last = n > 0 ? s.renumbered.back() : 0;
    const Index count = exclusive_scan(s.renumbered);
    s.old.resize(count);
    parallel_for(n, [&](std::size_t i) {
        const bool stays = i + 1 < n ? s.renumbered[i + 1] != s.renumbered[i] : last != 0;
        if (stays) s.old[s.renumbered[i]] = static_cast<Index>(i);
    });
    return s;
}

void select_attributes(Mesh& mesh, Domain domain, const std::vector<Index>& old) {
    for (auto& a : mesh.attributes)
        if (a.domain == domain) a.select(old);
}

template <class T>
std::vector<T> selected(const std::vector<T>& from, const std::vector<Index>& old) {
    std::vector<T> to(old.size());
    parallel_for(old.size(), [&](std::size_t i) { to[i] = from[old[i]]; });
    return to;
}

void renumber(std::vector<Index>& indices, const std::vector<Index>& renumbered) {
    parallel_for(indices.size(), [&](std::size_t i) { indices[i] = renumbered[indices[i]]; });
}

/// 1 for each of n elements that the indices name.
std::vector<Index> used(std::size_t n, const std::vector<Index>& indices) {
    std::vector<Index> flags(n, 0);
    for (const Index i : indices) flags[i] = 1;
    return flags;
}

} // namespace

void drop_unused(Mesh& mesh) {
    const Survivors wedges = survivors(used(mesh.wedge_count(), mesh.corners));
    if (wedges.old.size() != mesh.wedge_count()) {
        renumber(mesh.corners, wedges.renumbered);
        select_attributes(mesh, Domain::wedge, wedges.old);
        if (mesh.has_seams()) mesh.wedge_vertex = selected(mesh.wedge_vertex, wedges.old);
    }
    if (!mesh.has_seams()) {
        if (wedges.old.size() == mesh.positions.size()) return;
        mesh.positions = selected(mesh.positions, wedges.old);
        select_attributes(mesh, Domain::vertex, wedges.old);
        return;
    }
    const Survivors vertices = survivors(used(mesh.vertex_count(), mesh.wedge_vertex));
    if (vertices.old.size() != mesh.vertex_count()) {
        mesh.positions = selected(mesh.positions, vertices.old);
        renumber(mesh.wedge_vertex, vertices.renumbered);
        select_attributes(mesh, Domain::vertex, vertices.old);
    }
    normalise_wedges(mesh);
}

namespace {

struct HashedVertex {
    Index vertex;
    std::uint32_t hash; ///< low bits choose the bucket, the others the slot in it
};

/// What is not a number equals nothing, so that many with one hash would each be compared with all before:
/// the index keeps them apart.
std::uint32_t position_hash(const Vec3& p, std::size_t v) {
    std::uint64_t h = p == p ? 0 : hashed(1, v);
    for (std::size_t i = 0; i < 3; ++i)
        h = hashed(h, std::bit_cast<std::uint64_t>(p[i] + 0.0)); // -0 + 0 is 0
    return static_cast<std::uint32_t>(h);
}

constexpr int bucket_bits = 11; // one pass of the radix sort

constexpr std::size_t few = 4096; // vertices that are one bucket: buckets cost more than they save

/// Sets first[v] to the first vertex at v's position, for the vertices of one bucket (ascending).
void find_firsts(std::span<const HashedVertex> bucket, const std::vector<Vec3>& positions,
                 std::vector<Index>& first) {
    const std::size_t slots = std::bit_ceil(2 * bucket.size());
    std::vector<HashedVertex> table(slots, {none, 0});
    for (const auto& item : bucket) {
        std::size_t slot = (item.hash >> bucket_bits) & (slots - 1);
        while (table[slot].vertex != none &&
               !(table[slot].hash == item.hash && positions[table[slot].vertex] == positions[item.vertex]))
            slot = (slot + 1) & (slots - 1);
        if (table[slot].vertex == none) table[slot] = item;
        first[item.vertex] = table[slot].vertex;
    }
}

/// For each vertex the first one at the same position. A hash splits the vertices into buckets that fit the
/// cache; each bucket is then one small hash table. (Sorting by the coordinates took four times as long.)
std::vector<Index> first_at_position(const std::vector<Vec3>& positions) {
    std::vector<HashedVertex> items(positions.size());
    parallel_for(items.size(), [&](std::size_t v) {
        items[v] = {static_cast<Index>(v), position_hash(positions[v], v)};
    });
    std::vector<Index> first(positions.size());
    if (items.size() <= few) {
        find_firsts(items, positions, first);
        return first;
    }
    constexpr std::uint32_t buckets = 1u << bucket_bits;
    const auto bucket_of = [](const HashedVertex& item) { return item.hash & (buckets - 1); };
    radix_sort(items, bucket_of, bucket_bits);
    Share::loop_tells();
    parallel_for(
        buckets,
        [&](std::size_t b) {
            const auto before = [&](std::size_t bucket) {
                return std::lower_bound(
                    items.begin(), items.end(), bucket,
                    [&](const HashedVertex& item, std::size_t x) { return bucket_of(item) < x; });
            };
            const auto begin = before(b), end = before(b + 1);
            if (begin != end) find_firsts({&*begin, static_cast<std::size_t>(end - begin)}, positions, first);
        },
        1);
    return first;
}

} // namespace

std::size_t weld_exact(Mesh& mesh) {
    const std::size_t n = mesh.vertex_count();
    std::vector<Index> first = first_at_position(mesh.positions), flags(n);
    parallel_for(n, [&](std::size_t v) { flags[v] = first[v] == v ? 1 : 0; });
    const Survivors vertices = survivors(std::move(flags));
    if (vertices.old.size() == n) return 0;
    parallel_for(
        n, [&](std::size_t v) { first[v] = vertices.renumbered[first[v]]; }); // now: the new vertex of each
    if (!has_attributes(mesh, Domain::wedge)) {                               // nothing to keep apart
        if (mesh.has_seams()) renumber(mesh.corners, mesh.wedge_vertex);
        mesh.wedge_vertex = {};
        renumber(mesh.corners, first);
    } else if (mesh.has_seams()) {
        renumber(mesh.wedge_vertex, first);
    } else {
        mesh.wedge_vertex = std::move(first);
    }
    mesh.positions = selected(mesh.positions, vertices.old);
    select_attributes(mesh, Domain::vertex, vertices.old);
    return n - mesh.vertex_count();
}

} // namespace facetmill

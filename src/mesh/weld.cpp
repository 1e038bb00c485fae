// Removes unused and coincident vertices and wedges.
#include "mesh/weld.hpp"
#include "base/progress.hpp"
#include "mesh/position_hash.hpp"
#include "mesh/provenance.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <bit>

namespace facetmill {

namespace {

/// The remaining elements of a domain: the old index of each remaining element, and the new index of each
/// old element.
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

namespace {

/// flags: 1 for the wedges that stay, including the wedges of all faces and lines.
void keep_wedges(Mesh& mesh, std::vector<Index> flags) {
    const Survivors wedges = survivors(std::move(flags));
    if (wedges.old.size() != mesh.wedge_count()) {
        renumber(mesh.corners, wedges.renumbered);
        renumber(mesh.lines, wedges.renumbered);
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

std::vector<Index> used_wedges(const Mesh& mesh) {
    std::vector<Index> flags = used(mesh.wedge_count(), mesh.corners);
    for (const Index w : mesh.lines) flags[w] = 1;
    return flags;
}

} // namespace

void drop_unused(Mesh& mesh) { keep_wedges(mesh, used_wedges(mesh)); }

void drop_unused(Mesh& mesh, std::span<const std::uint8_t> marked) {
    std::vector<Index> flags = used_wedges(mesh);
    for (Index w = 0; w < flags.size(); ++w)
        if (!marked[mesh.vertex_of_wedge(w)]) flags[w] = 1;
    keep_wedges(mesh, std::move(flags));
}

namespace {

struct HashedVertex {
    Index vertex;
    std::uint32_t hash; ///< low bits choose the bucket, the others the slot in it
};

/// NaN equals no number, so each of many NaNs with the same hash would be compared with all earlier NaNs.
/// The index separates them.
std::uint32_t position_hash(const Vec3& p, std::size_t v) {
    if (!(p == p)) return static_cast<std::uint32_t>(place_hash(v, 0, 0));
    return static_cast<std::uint32_t>(place_hash(p));
}

constexpr int bucket_bits = 11; // bits of the radix sort's only pass

constexpr std::size_t few = 4096; // below this many vertices, a single bucket is faster

/// Finds the hashes that occur more than once, plus a few others: a bit for each of 16 times as many hashes
/// as exist (a Bloom filter with one function, after B. H. Bloom, "Space/time trade-offs in hash coding with
/// allowable errors", 1970). All threads may add.
class Repeated {
  public:
    explicit Repeated(std::size_t hashes)
        : words_(std::min(std::bit_ceil(hashes) / 4, std::size_t{1} << 26)), once_(words_), again_(words_) {}

    const void* place(std::uint32_t hash) const { return &once_[word(hash)]; }
    void add(std::uint32_t hash) {
        std::atomic_ref<std::uint64_t> once(once_[word(hash)]);
        const bool known = once.fetch_or(bit(hash), std::memory_order_relaxed) & bit(hash);
        if (!known) return;
        std::atomic_ref<std::uint64_t>(again_[word(hash)]).fetch_or(bit(hash), std::memory_order_relaxed);
    }
    bool may_be(std::uint32_t hash) const { return (again_[word(hash)] & bit(hash)) != 0; }

  private:
    std::size_t word(std::uint32_t hash) const { return (hash >> 6) & (words_ - 1); }
    static std::uint64_t bit(std::uint32_t hash) { return std::uint64_t{1} << (hash & 63); }

    std::size_t words_;
    std::vector<std::uint64_t> once_, again_;
};

/// The vertices that share their position with others, in order, and a few more; all if the mesh is small.
std::vector<HashedVertex> doubtful_vertices(const std::vector<Vec3>& positions) {
    const std::size_t n = positions.size();
    if (n <= few) {
        std::vector<HashedVertex> all(n);
        for (std::size_t v = 0; v < n; ++v) all[v] = {static_cast<Index>(v), position_hash(positions[v], v)};
        return all;
    }
    std::vector<std::uint32_t> hashes(n);
    Repeated repeated(n);
    parallel_chunks(n, [&](std::size_t begin, std::size_t end) {
        constexpr std::size_t block = 32; // hashes whose bits are prefetched
        for (std::size_t at = begin; at < end; at += block) {
            const std::size_t last = std::min(at + block, end);
            for (std::size_t v = at; v < last; ++v) {
                hashes[v] = position_hash(positions[v], v);
                __builtin_prefetch(repeated.place(hashes[v]), 1);
            }
            for (std::size_t v = at; v < last; ++v) repeated.add(hashes[v]);
        }
    });
    return parallel_reduce(
        n, std::vector<HashedVertex>{},
        [&](std::size_t begin, std::size_t end) {
            std::vector<HashedVertex> found;
            for (std::size_t v = begin; v < end; ++v)
                if (repeated.may_be(hashes[v])) found.push_back({static_cast<Index>(v), hashes[v]});
            return found;
        },
        [](std::vector<HashedVertex> all, const std::vector<HashedVertex>& more) {
            all.insert(all.end(), more.begin(), more.end());
            return all;
        });
}

/// Sets first[v] to the first vertex at v's position, for the vertices of a bucket (ascending).
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

} // namespace

/// Distributes these vertices by a hash to buckets that fit the cache; each bucket is then one small hash
/// table. (Sorting by the coordinates took four times as long.)
std::vector<Index> first_at_position(const std::vector<Vec3>& positions) {
    std::vector<HashedVertex> items = doubtful_vertices(positions);
    std::vector<Index> first(positions.size());
    parallel_for(first.size(), [&](std::size_t v) { first[v] = static_cast<Index>(v); });
    if (items.size() <= few) {
        find_firsts(items, positions, first);
    } else {
        constexpr std::uint32_t buckets = 1u << bucket_bits;
        const auto bucket_of = [](const HashedVertex& item) { return item.hash & (buckets - 1); };
        radix_sort(items, bucket_of, bucket_bits);
        ProgressScope::report_next_loop();
        parallel_for(
            buckets,
            [&](std::size_t b) {
                const auto before = [&](std::size_t bucket) {
                    return std::lower_bound(
                        items.begin(), items.end(), bucket,
                        [&](const HashedVertex& item, std::size_t x) { return bucket_of(item) < x; });
                };
                const auto begin = before(b), end = before(b + 1);
                if (begin != end)
                    find_firsts({&*begin, static_cast<std::size_t>(end - begin)}, positions, first);
            },
            1);
    }
    const bool any = std::any_of(items.begin(), items.end(),
                                 [&](const HashedVertex& item) { return first[item.vertex] != item.vertex; });
    if (!any) first.clear();
    return first;
}

std::size_t weld_exact(Mesh& mesh) {
    const std::size_t n = mesh.vertex_count();
    std::vector<Index> first = first_at_position(mesh.positions);
    if (first.empty()) return 0;
    std::vector<Index> flags(n);
    parallel_for(n, [&](std::size_t v) { flags[v] = first[v] == v ? 1 : 0; });
    const Survivors vertices = survivors(std::move(flags));
    parallel_for(n, [&](std::size_t v) {
        first[v] = vertices.renumbered[first[v]];
    });                                         // first now has the new vertex of each
    if (!has_attributes(mesh, Domain::wedge)) { // no attributes to keep separate
        for (auto* indices : {&mesh.corners, &mesh.lines}) {
            if (mesh.has_seams()) renumber(*indices, mesh.wedge_vertex);
            renumber(*indices, first);
        }
        mesh.wedge_vertex = {};
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

#pragma once
// Items of the faces of a mesh, grouped by vertex: the basis of edge tables and of vertex neighbourhoods.

#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"
#include "parallel/storage.hpp"

#include <algorithm>
#include <bit>

namespace facetmill {

/// Items in buckets by the high bits of a vertex: one scattering pass, after which each bucket (some thousand
/// items) is sorted in cache. That is a radix sort whose first digit is wide and whose others never leave the
/// cache.
template <class Item>
struct Buckets {
    int shift = 0;                  ///< bucket of vertex v: v >> shift
    std::vector<Item> items;        ///< bucket by bucket, in the order of their faces
    std::vector<std::size_t> begin; ///< [buckets + 1] into items
    std::size_t count() const { return begin.size() - 1; }
    /// How many buckets one thread takes at a time: of a mesh of few items all, since another thread would
    /// take longer to come.
    std::size_t at_once() const {
        constexpr std::size_t least = 16, few = 1 << 13; // items
        return std::max(least, count() * few / std::max<std::size_t>(1, items.size()));
    }
    std::span<const Item> of(std::size_t b) const {
        return {items.data() + begin[b], items.data() + begin[b + 1]};
    }
    /// The vertices of bucket b: [first_vertex(b), first_vertex(b + 1)), the last cut at the number of
    /// vertices.
    std::size_t first_vertex(std::size_t b) const { return b << shift; }
};

/// The first of the high bits that select the bucket of a vertex: 11 bits, so at most 2048 buckets.
[[nodiscard]] inline int shift_of_buckets(std::size_t vertices) {
    const auto bits = static_cast<int>(std::bit_width(vertices > 0 ? vertices - 1 : 0));
    return std::max(0, bits - 11);
}
[[nodiscard]] inline std::size_t number_of_buckets(std::size_t vertices) {
    return vertices == 0 ? 0 : ((vertices - 1) >> shift_of_buckets(vertices)) + 1;
}

/// visit(f, emit) calls emit(vertex, item) for each contribution of face f.
template <class Item, class Visit>
[[nodiscard]] Buckets<Item> fill_buckets(std::size_t faces, std::size_t vertices, Visit&& visit) {
    constexpr std::size_t chunk = std::size_t{1} << 15;
    Buckets<Item> result;
    result.shift = shift_of_buckets(vertices);
    const std::size_t buckets = number_of_buckets(vertices), chunks = (faces + chunk - 1) / chunk;
    std::vector<std::size_t> counts(chunks * buckets, 0);
    const auto for_faces = [&](auto&& body) {
        parallel_chunks(
            faces,
            [&](std::size_t begin, std::size_t end) {
                std::size_t* mine = counts.data() + begin / chunk * buckets;
                for (std::size_t f = begin; f < end; ++f)
                    visit(static_cast<Index>(f),
                          [&](Index v, const Item& item) { body(mine[v >> result.shift], item); });
            },
            chunk);
    };
    for_faces([](std::size_t& count, const Item&) { ++count; });
    result.begin.resize(buckets + 1, 0);
    std::size_t sum = 0;
    for (std::size_t b = 0; b < buckets; ++b) {
        result.begin[b] = sum;
        for (std::size_t c = 0; c < chunks; ++c) sum += std::exchange(counts[c * buckets + b], sum);
    }
    result.begin[buckets] = sum;
    resize_large(result.items, sum);
    for_faces([&](std::size_t& at, const Item& item) { result.items[at++] = item; });
    return result;
}
template <class Item, class Visit>
[[nodiscard]] Buckets<Item> fill_buckets(const Mesh& mesh, Visit&& visit) {
    return fill_buckets<Item>(mesh.face_count(), mesh.vertex_count(), std::forward<Visit>(visit));
}

} // namespace facetmill

#pragma once
// Groups items of the faces of a mesh by vertex, for edge tables and vertex neighbourhoods.

#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"
#include "parallel/storage.hpp"

#include <algorithm>
#include <bit>

namespace facetmill {

/// Items in buckets by the high bits of a vertex. After a single scattering pass, each bucket (a few
/// thousand items) is sorted in the cache. This is a radix sort with a wide first digit.
template <class Item>
struct Buckets {
    int shift = 0;                  ///< the bucket of vertex v is v >> shift
    std::vector<Item> items;        ///< bucket by bucket, in the order of their faces
    std::vector<std::size_t> begin; ///< [buckets + 1] offsets into items
    std::size_t count() const { return begin.size() - 1; }
    /// The number of buckets that a thread takes at a time. For few items it is all buckets, because
    /// starting another thread would take longer.
    std::size_t at_once() const {
        constexpr std::size_t least = 16, few = 1 << 13; // numbers of items
        return std::max(least, count() * few / std::max<std::size_t>(1, items.size()));
    }
    std::span<const Item> of(std::size_t b) const {
        return {items.data() + begin[b], items.data() + begin[b + 1]};
    }
    /// Bucket b has the vertices from first_vertex(b) to before first_vertex(b + 1), limited to the number
    /// of vertices.
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

/// Fills the buckets. visit(f, emit) must call emit(vertex, item) for each contribution of face f.
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

#pragma once
// Parallel loops over fixed chunks, with the same result for any number of threads. Chunk boundaries depend
// only on the size, and reductions join the chunks in index order, so floating-point sums never change.

#include "parallel/storage.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace facetmill {

/// Sets the number of threads of the process; 0: all cores. Call it once, at the start. Throws
/// std::bad_alloc if memory for the scheduler is short.
void set_threads(int count);
[[nodiscard]] int threads();

inline constexpr std::size_t default_chunk = 8192;

/// Calls call(body, begin, end) for chunks of [0, n): parallel_chunks without its template, so that the
/// scheduler's code is compiled once and not for every loop.
void run_chunks(std::size_t n, std::size_t chunk, void* body, void (*call)(void*, std::size_t, std::size_t));

/// Calls body(begin, end) for chunks of [0, n). An Error thrown by a body ends the loop and is rethrown.
template <class Body>
void parallel_chunks(std::size_t n, Body&& body, std::size_t chunk = default_chunk) {
    using Loop = std::remove_reference_t<Body>;
    run_chunks(
        n, chunk, const_cast<void*>(static_cast<const void*>(std::addressof(body))),
        [](void* loop, std::size_t begin, std::size_t end) { (*static_cast<Loop*>(loop))(begin, end); });
}

/// Calls body(i) for i in [0, n).
template <class Body>
void parallel_for(std::size_t n, Body&& body, std::size_t chunk = default_chunk) {
    parallel_chunks(
        n,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) body(i);
        },
        chunk);
}

/// Joins map(begin, end) of every chunk from left to right: join(join(first, second), third) ...
template <class T, class Map, class Join>
T parallel_reduce(std::size_t n, T identity, Map&& map, Join&& join, std::size_t chunk = default_chunk) {
    std::vector<T> parts((n + chunk - 1) / chunk, identity);
    parallel_chunks(
        n, [&](std::size_t begin, std::size_t end) { parts[begin / chunk] = map(begin, end); }, chunk);
    T all = std::move(identity);
    for (auto& part : parts) all = join(std::move(all), std::move(part));
    return all;
}

/// Replaces counts by their running sum from 0, and returns the total: {3, 1, 2} becomes {0, 3, 4}, with
/// total 6.
template <class T>
T exclusive_scan(std::vector<T>& counts) {
    T sum = 0;
    for (T& c : counts) c = std::exchange(sum, sum + c);
    return sum;
}

/// A key, and the index of its item.
struct KeyedPlace {
    std::uint64_t key;
    std::uint32_t place;
};
/// Sorts by key, then by index. This part of radix_sort is compiled once.
void sort_few(std::span<KeyedPlace> places);

/// Sorts items by a 64-bit key (key(item), below 2^key_bits). Stable; a parallel radix sort, or a comparison
/// sort for few items.
template <class T, class Key>
void radix_sort(std::vector<T>& items, Key&& key, int key_bits = 64) {
    constexpr std::size_t few =
        256; // below this, visiting the buckets of all digits is slower than comparing
    if (items.size() <= few) {
        std::array<KeyedPlace, few> places;
        for (std::size_t i = 0; i < items.size(); ++i)
            places[i] = {static_cast<std::uint64_t>(key(items[i])), static_cast<std::uint32_t>(i)};
        sort_few(std::span(places).first(items.size()));
        std::vector<T> other(items.size());
        for (std::size_t i = 0; i < other.size(); ++i) other[i] = items[places[i].place];
        items.swap(other);
        return;
    }
    constexpr int digit_bits = 11;
    constexpr std::size_t buckets = std::size_t{1} << digit_bits, chunk = std::size_t{1} << 16;
    const std::size_t n = items.size(), chunks = (n + chunk - 1) / chunk;
    std::vector<T> other;
    resize_large(other, n);
    std::vector<std::size_t> counts(chunks * buckets);
    for (int shift = 0; shift < key_bits; shift += digit_bits) {
        const auto digit = [&](const T& item) {
            return (static_cast<std::uint64_t>(key(item)) >> shift) & (buckets - 1);
        };
        std::fill(counts.begin(), counts.end(), 0);
        parallel_chunks(
            n,
            [&](std::size_t begin, std::size_t end) {
                std::size_t* mine = &counts[begin / chunk * buckets];
                for (std::size_t i = begin; i < end; ++i) ++mine[digit(items[i])];
            },
            chunk);
        std::size_t sum = 0;
        for (std::size_t b = 0; b < buckets; ++b)
            for (std::size_t c = 0; c < chunks; ++c) sum += std::exchange(counts[c * buckets + b], sum);
        parallel_chunks(
            n,
            [&](std::size_t begin, std::size_t end) {
                std::size_t* mine = &counts[begin / chunk * buckets];
                for (std::size_t i = begin; i < end; ++i) other[mine[digit(items[i])]++] = items[i];
            },
            chunk);
        items.swap(other);
    }
}

} // namespace facetmill

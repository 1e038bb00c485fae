#pragma once
// Vectors of four float32 numbers, for which every processor has instructions.

#include <cstddef>
#include <cstdint>

namespace facetmill {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

[[nodiscard]] inline Float4 load(const float (&four)[4]) {
    return Float4{four[0], four[1], four[2], four[3]};
}
[[nodiscard]] inline Float4 greater(const Float4& a, const Float4& b) { return a > b ? a : b; }
[[nodiscard]] inline Float4 lesser(const Float4& a, const Float4& b) { return a < b ? a : b; }

/// One bit for each lane of a comparison, the first lane lowest.
[[nodiscard]] inline unsigned bits_of(const Int4& truths) {
#if defined(__SSE__)
    return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<const Float4&>(truths)));
#else
    return (truths[0] & 1u) | (truths[1] & 2u) | (truths[2] & 4u) | (truths[3] & 8u);
#endif
}

/// Prefetches an object that will be read soon. Always inline: GCC 12 drops calls of functions that do
/// nothing else.
template <class T>
[[gnu::always_inline]] inline void fetch_soon(const T& object) {
    const char* const begin = reinterpret_cast<const char*>(&object);
    for (std::size_t at = 0; at < sizeof(T); at += 64) __builtin_prefetch(begin + at);
    __builtin_prefetch(begin + sizeof(T) - 1);
}

} // namespace facetmill

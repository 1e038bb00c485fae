#pragma once
// A histogram of edge costs by their leading bits; each pass takes its threshold from it.

#include "base/math/vec.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace facetmill::simplification {

inline constexpr int bucket_shift = 19; ///< drops bits of a cost, so that 16 buckets cover a power of two
inline constexpr std::size_t buckets = 0x7f800000u >> bucket_shift; ///< number of buckets for finite costs

/// The number of edges whose costs have the same leading bits.
struct Bucket {
    std::size_t number, edges;
};

/// Sorts the buckets and merges equal numbers.
[[nodiscard]] inline std::vector<Bucket> gathered(std::vector<Bucket> filled) {
    std::sort(filled.begin(), filled.end(),
              [](const Bucket& a, const Bucket& b) { return a.number < b.number; });
    std::size_t kept = 0;
    for (const Bucket& b : filled)
        if (kept > 0 && filled[kept - 1].number == b.number)
            filled[kept - 1].edges += b.edges;
        else
            filled[kept++] = b;
    filled.resize(kept);
    return filled;
}

/// The bits of a cost limit. At most `wanted` edges are below it, except that the first bucket is always
/// included; no bucket after `last` is. filled: ascending, without empty buckets.
[[nodiscard]] inline std::uint32_t cost_limit(std::span<const Bucket> filled, std::size_t wanted,
                                              std::size_t last) {
    std::size_t below = 0;
    for (const Bucket& b : filled) {
        if (below > 0 && (below + b.edges > wanted || b.number > last))
            return static_cast<std::uint32_t>(b.number) << bucket_shift;
        below += b.edges;
    }
    return static_cast<std::uint32_t>(buckets) << bucket_shift;
}

} // namespace facetmill::simplification

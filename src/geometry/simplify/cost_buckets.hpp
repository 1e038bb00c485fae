#pragma once
// Costs of edges by their leading bits, from which a pass takes its threshold.

#include "base/math/vec.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace facetmill::simplification {

inline constexpr int bucket_shift = 19; ///< of a cost's bits: 16 buckets per power of two
inline constexpr std::size_t buckets = 0x7f800000u >> bucket_shift; ///< of finite costs

/// Costs that agree in their leading bits, and how many edges have them.
struct Bucket {
    std::size_t number, edges;
};

/// In ascending order, each number once.
inline std::vector<Bucket> gathered(std::vector<Bucket> filled) {
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

/// The bits of a cost below which there are so many edges at most, or those of the first bucket, and none in
/// a bucket beyond `last`. filled: ascending, none of them empty.
inline std::uint32_t cost_limit(std::span<const Bucket> filled, std::size_t wanted, std::size_t last) {
    std::size_t below = 0;
    for (const Bucket& b : filled) {
        if (below > 0 && (below + b.edges > wanted || b.number > last))
            return static_cast<std::uint32_t>(b.number) << bucket_shift;
        below += b.edges;
    }
    return static_cast<std::uint32_t>(buckets) << bucket_shift;
}

} // namespace facetmill::simplification

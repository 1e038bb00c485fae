#include "geometry/bake/fill.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill::baking {

namespace {

/// [texels] The nearest covered row in the same column, or -1 if none is within reach. After A. Meijster, J.
/// Roerdink, W. Hesselink, "A general algorithm for computing distance transforms in linear time" (2000).
std::vector<std::int32_t> nearest_rows(const std::vector<std::uint8_t>& covered, int size, int reach) {
    std::vector<std::int32_t> rows(covered.size(), -1);
    const auto side = static_cast<std::size_t>(size);
    constexpr std::size_t columns = 64; // neighbouring columns share cache lines
    parallel_chunks(
        side,
        [&](std::size_t begin, std::size_t end) {
            std::vector<std::int32_t> last(end - begin, -1);
            for (int y = 0; y < size; ++y)
                for (std::size_t x = begin; x < end; ++x) {
                    const std::size_t at = static_cast<std::size_t>(y) * side + x;
                    std::int32_t& above = last[x - begin];
                    if (covered[at]) above = y;
                    if (above >= 0 && y - above <= reach) rows[at] = above;
                }
            std::fill(last.begin(), last.end(), -1);
            for (int y = size; y-- > 0;)
                for (std::size_t x = begin; x < end; ++x) {
                    const std::size_t at = static_cast<std::size_t>(y) * side + x;
                    std::int32_t& below = last[x - begin];
                    if (covered[at]) below = y;
                    if (below < 0 || below - y > reach) continue;
                    if (rows[at] < 0 || below - y < y - rows[at]) rows[at] = below;
                }
        },
        columns);
    return rows;
}

} // namespace

std::vector<std::uint32_t> nearest_covered(const std::vector<std::uint8_t>& covered, int size, int reach) {
    const std::vector<std::int32_t> rows = nearest_rows(covered, size, reach);
    std::vector<std::uint32_t> sources(covered.size(), UINT32_MAX);
    const auto side = static_cast<std::size_t>(size);
    parallel_for(
        side,
        [&](std::size_t row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < size; ++x) {
                const std::size_t at = row * side + static_cast<std::size_t>(x);
                if (covered[at]) {
                    sources[at] = static_cast<std::uint32_t>(at);
                    continue;
                }
                int best = reach * reach + 1;
                for (int i = std::max(0, x - reach); i <= std::min(size - 1, x + reach); ++i) {
                    const std::int32_t other = rows[row * side + static_cast<std::size_t>(i)];
                    if (other < 0) continue;
                    const int distance = (i - x) * (i - x) + (other - y) * (other - y);
                    if (distance >= best) continue;
                    best = distance;
                    sources[at] = static_cast<std::uint32_t>(static_cast<std::size_t>(other) * side +
                                                             static_cast<std::size_t>(i));
                }
            }
        },
        16);
    return sources;
}

} // namespace facetmill::baking

#pragma once
// Packs rectangles onto plates.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace facetmill {

struct NestRectangle {
    double width = 0, depth = 0; ///< at least 0
};

struct NestSettings {
    double width = 1, depth = 1;   ///< of a plate, above zero
    double spacing = 0;            ///< between rectangles, at least 0
    bool turns = true;             ///< rectangles may turn by 90 degrees
    std::size_t plates = SIZE_MAX; ///< the maximum number of plates
};

struct NestPlace {
    std::size_t plate = 0;
    double x = 0, y = 0; ///< the lowest corner
    bool turned = false;
};

/// The place of each rectangle; none if it does not fit. Rectangles do not overlap, keep the spacing to each
/// other, and are inside their plate, up to 1e-9 of its size for the rounding of sums. Larger rectangles are
/// placed first: by the longer side, then by the shorter. Each goes to the first plate with room, where its
/// upper side is lowest, then its place leftmost: the skyline heuristic of J. Jylänki, "A Thousand Ways to
/// Pack the Bin" (2010). O(n^2) for each plate.
[[nodiscard]] std::vector<std::optional<NestPlace>> nest(std::span<const NestRectangle> rectangles,
                                                         const NestSettings& settings);

} // namespace facetmill

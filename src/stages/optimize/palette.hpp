#pragma once
// Replaces materials of plain colours by pixels of a palette texture.

#include "io/gltf/optimize/document_optimizer.hpp"
#include "mesh/scene.hpp"

#include <set>

namespace facetmill::optimize_stage {

struct PaletteCounts {
    std::size_t palettes = 0, materials = 0; ///< numbers of palettes made and of materials merged into them
    std::size_t too_many_looks = 0;          ///< the largest number of looks that exceeded most_looks
};

/// The maximum number of looks in a palette, so that 12-bit texture coordinates distinguish them.
inline constexpr std::size_t most_looks = 512;

/// Gives parts without texture coordinates and with plain materials a palette material, if at least `least`
/// different looks of the same kind share it. Marks the parts as changed. parts: part numbers.
[[nodiscard]] PaletteCounts make_palettes(Scene& scene, std::vector<io::DocumentOptimizer>& documents,
                                          const std::vector<std::size_t>& parts, std::size_t least);

} // namespace facetmill::optimize_stage

#pragma once
// Materials of plain colours as pixels of one.

#include "io/gltf/optimize/document_optimizer.hpp"
#include "mesh/scene.hpp"

#include <set>

namespace facetmill::optimize_stage {

struct PaletteCounts {
    std::size_t palettes = 0, materials = 0; ///< made, and that went into them
    std::size_t too_many_looks = 0; ///< the most of one that was not made for having more than most_looks
};

/// Looks of one palette, so that the 12 bits of a texture coordinate tell them apart.
inline constexpr std::size_t most_looks = 512;

/// Gives parts without texture coordinates, whose primitives have plain materials, a palette's, where at
/// least `least` different looks of one kind meet in it. Marks the parts as changed. parts: by their numbers.
PaletteCounts make_palettes(Scene& scene, std::vector<io::DocumentOptimizer>& documents,
                            const std::vector<std::size_t>& parts, std::size_t least);

} // namespace facetmill::optimize_stage

#pragma once
// The option `grid: even`: a common step of positions for all parts of a scene.

#include "io/codec.hpp"

#include <vector>

namespace facetmill::write_stage {

/// The grid for each part's positions, and the number of bits for grid coordinates.
struct EvenGrid {
    std::vector<io::Lattice> lattices;
    std::vector<int> bits;
};

/// The scene's longest side in the world is divided into 2^bits - 1 steps, which all parts share. If a node
/// enlarges a part, the step in the part's own coordinates is shorter. Parts that nodes do not rotate are
/// rounded to the same world points. If vertices of a part would coincide, its step is halved until they
/// stay distinct, up to 2^limit - 1 steps along its own longest side. Parts of the same mesh of a document
/// share the finest step among them. Parts that are `left`, empty or not finite have no lattice and keep
/// their usual bits, as do scenes of a single part or point.
[[nodiscard]] EvenGrid even_grid(const Scene& scene, const std::vector<int>& usual, int bits, int limit,
                                 const std::vector<bool>& left);

} // namespace facetmill::write_stage

#pragma once
// The same steps of positions for all parts of a scene (grid: even).

#include "io/codec.hpp"

#include <vector>

namespace facetmill::write_stage {

/// What each part's positions are rounded to, and how many bits the whole numbers take.
struct EvenGrid {
    std::vector<io::Lattice> lattices;
    std::vector<int> bits;
};

/// The longest side of the scene, in the world, is divided into 2^bits - 1 steps, which every part has: in
/// its own coordinates a step is shorter where its node enlarges it. Parts that their nodes do not turn are
/// rounded to the same points of the world. A part some of whose vertices would coincide has steps of a half,
/// a quarter
/// ... of it, down to 2^limit - 1 for its own longest side, if that keeps them apart. Parts of one mesh of a
/// document have the finest steps that one of them needs. Parts that are `left`, empty or not finite have no
/// lattice and keep their usual bits; so do all in a scene of a single part or point.
[[nodiscard]] EvenGrid even_grid(const Scene& scene, const std::vector<int>& usual, int bits, int limit,
                                 const std::vector<bool>& left);

} // namespace facetmill::write_stage

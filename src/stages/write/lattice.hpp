#pragma once
// The option `grid: even`: a common step of positions for all parts of a scene.

#include "io/codec.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/equal_meshes.hpp"

#include <vector>

namespace facetmill::write_stage {

/// The grid for each part's positions, and the number of bits for grid coordinates.
struct EvenGrid {
    std::vector<io::Lattice> lattices;
    std::vector<int> bits;
};

/// Equal parts that share a grid, so that their geometry is stored once: nodes enlarge them by the same
/// factor, or they share a mesh of a document.
[[nodiscard]] DistinctParts parts_sharing_grids(const Scene& scene, const std::vector<io::PartView>& views);

struct BitLimits {
    double whole = 0;   ///< the longest side of the drawn contents (drawn_bounds)
    int usual = 14;     ///< divide it
    int most = 16;      ///< of a part
    bool draco = false; ///< stores each part's origin as float32, and bits at no cost
};

/// The whole length is divided into 2^usual - 1 steps, which all parts share.
/// If a node enlarges a part, the step in the part's own coordinates is shorter. Parts that nodes do not
/// rotate are rounded to the same world points; under Draco, they have the same origin and bits, so that
/// equal points stay equal to the last bit. If vertices of a part would coincide, its step is halved until
/// they stay distinct. The limit is 2^most - 1 steps along the part's own longest side. Parts that
/// share a grid (shapes) have the finest step among them. Parts that are animated, empty or not finite have
/// no lattice and keep their usual bits. The same applies to scenes of a single part or point.
[[nodiscard]] EvenGrid even_grid(const Scene& scene, const DistinctParts& shapes,
                                 const std::vector<int>& usual, const BitLimits& limits,
                                 const std::vector<io::PartView>& views);

} // namespace facetmill::write_stage

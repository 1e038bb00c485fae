#pragma once
// Places the textures of materials in an atlas.

#include "stages/textures/atlas_uvs.hpp"

#include <optional>

namespace facetmill::textures_stage {

/// Materials that use the same images in the same way, and their place. Sizes are in texels of the atlas, and
/// multiples of the gutter.
struct AtlasTile {
    std::vector<Index> materials; ///< of the scene
    UvExtent extent;
    std::size_t image_width = 0, image_height = 0; ///< of the largest texture; 0 for plain colours
    std::size_t halvings = 0;
    std::int64_t left = 0, top = 0;    ///< the first texel of the texture that faces use
    std::size_t width = 0, height = 0; ///< of the texels that faces use
    std::size_t x = 0, y = 0;          ///< their place in the atlas

    /// The size of the largest texture, after the halvings.
    [[nodiscard]] std::size_t side(std::size_t axis) const;
    /// The place of a point of the texture in the atlas.
    [[nodiscard]] Uv place(const Uv& uv) const;
};

struct AtlasLayout {
    std::vector<AtlasTile> tiles;
    std::size_t width = 0, height = 0;
};

/// Places the tiles so that the atlas has a small area and sides of at most `limit`. Around each tile, a
/// gutter is free. While they do not fit, the texture with the most texels per area of its faces is halved.
/// None if they do not fit at all. gutter: a power of two.
[[nodiscard]] std::optional<AtlasLayout> lay_out(std::vector<AtlasTile> tiles, std::size_t limit,
                                                 std::size_t gutter);

} // namespace facetmill::textures_stage

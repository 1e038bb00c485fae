#pragma once
// Draws the maps of an atlas.

#include "io/images/resize_image.hpp"
#include "stages/textures/atlas_layout.hpp"

#include <functional>

namespace facetmill::textures_stage {

enum class AtlasMap { base, normal, surface, emission };

/// The materials of an atlas, and what they have in common.
struct AtlasPlan {
    AtlasLayout layout;
    std::size_t gutter = 0;
    std::vector<const io::AtlasMaterial*> looks; ///< [tiles]
    /// The factors of the new material. A texel gets the ratio of its own material's factor.
    io::AtlasMaterial common;
    bool opaque = true; ///< alpha is ignored

    [[nodiscard]] bool has_textures(AtlasMap map) const;
    /// Whether the materials differ in the map, or have textures of it.
    [[nodiscard]] bool needs(AtlasMap map) const;
    /// How many texels of the layout a texel of the map covers along a side: 1 for the map with the most
    /// texels, more for smaller textures, and the gutter for plain colours.
    [[nodiscard]] std::size_t divisor(AtlasMap map) const;
};

/// Gets the decoded image of a tile's texture.
using ImageGetter = std::function<io::Pixels(std::size_t tile, const io::AtlasTexture& texture)>;

/// Sets the common factors: the largest of all materials.
void find_common_factors(AtlasPlan& plan);

/// A map of the atlas. Texels are copied without a change if the texture has the size that the layout gives
/// it and the material has the common factors. Otherwise they are scaled down by resized_image, mixed
/// bilinearly, and multiplied, colours in linear light, normals as directions. The gutter continues each
/// texture as its sampler does.
[[nodiscard]] io::Pixels draw_map(const AtlasPlan& plan, AtlasMap map, const ImageGetter& image);

} // namespace facetmill::textures_stage

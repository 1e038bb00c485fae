#pragma once
// Textures and materials for rendering: images with mip levels, samplers and materials, as in glTF 2.0
// (Khronos, 2021) and KHR_texture_transform. File readers create them
// (io/gltf/contents/resolved_materials.hpp).

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace facetmill {

/// An image with its mip levels, each half as large as the previous, down to one pixel.
struct TextureImage {
    struct Level {
        int width = 0, height = 0;
        std::vector<std::uint8_t> rgba; ///< row by row from the top, with values as in the file
    };
    std::vector<Level> levels; ///< at least one level
    bool srgb = false;         ///< red, green and blue are in sRGB; otherwise plain numbers

    std::size_t bytes() const;
};

/// The image and its levels. Each pixel is the mean over the area that it covers, in linear light, with
/// colours weighted by alpha. Levels larger than max_side are dropped. rgba: 4 * width * height bytes, both
/// at least 1.
[[nodiscard]] std::shared_ptr<const TextureImage>
texture_image(int width, int height, std::vector<std::uint8_t> rgba, bool srgb, int max_side);

/// The TextureImage::bytes() of an image of this size.
[[nodiscard]] std::size_t texture_bytes(std::size_t width, std::size_t height, std::size_t max_side);

enum class TextureWrap { repeat, clamp, mirror };

/// Red, green, blue and alpha, with linear colours.
using Texel = std::array<float, 4>;

/// The colour for lines and single points without a colour. It contrasts equally with white and black, so
/// that it is visible on any background. (Its contrast is 4.2 to 1; graphics need 3 to 1: W3C, "Web Content
/// Accessibility Guidelines 2.1", 2018.)
inline constexpr Texel loose_colour{0.16f, 0.20f, 0.28f, 1};

/// The steps of the coordinates to the next pixel of the picture, right and down.
struct TextureFootprint {
    double du_dx = 0, dv_dx = 0, du_dy = 0, dv_dy = 0;
};

/// An image and its sampling.
struct Texture {
    std::shared_ptr<const TextureImage> image; ///< null: no texture
    int set = 0;                               ///< the n of TEXCOORD_n
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    bool nearest = false; ///< nearest-neighbour magnification
    /// u' = m[0] u + m[1] v + m[2], v' = m[3] u + m[4] v + m[5] (KHR_texture_transform)
    std::array<double, 6> transform{1, 0, 0, 0, 1, 0};

    explicit operator bool() const { return image != nullptr; }
    /// The mean over the footprint at (u, v), before the transform. It uses the two mip levels that fit the
    /// footprint's shorter side, bilinear in each. It takes up to eight samples along the longer side (after
    /// P. Heckbert, "Survey of Texture Mapping", 1986). Coordinates that are not finite count as 0.
    Texel sampled(double u, double v, const TextureFootprint& footprint) const;
};

/// The properties of a material. Pictures ignore metalness and roughness, because the scene has no
/// environment to reflect.
struct MaterialLook {
    enum class Alpha { opaque, mask, blend };

    std::array<float, 4> base{1, 1, 1, 1};
    std::array<float, 3> emissive{0, 0, 0};
    Texture base_texture, normal_texture, emissive_texture, occlusion_texture;
    Texture rough_texture; ///< green: roughness, blue: metalness; only if the resolver was asked for it
    float normal_scale = 1, occlusion_strength = 1, cutoff = 0.5f;
    float roughness = 1, metalness = 1;
    Alpha alpha = Alpha::opaque;
    bool unlit = false; ///< KHR_materials_unlit
};

/// The looks by index of the scene's materials.
using ResolvedMaterials = std::vector<MaterialLook>;

} // namespace facetmill

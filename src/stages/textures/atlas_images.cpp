#include "stages/textures/atlas_images.hpp"

#include "geometry/render/srgb.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace facetmill::textures_stage {

namespace {

using io::PixelKind;
using io::Pixels;
using Byte4 = std::array<std::uint8_t, 4>;

/// A texture of a tile, at the resolution of a map at most, and the channels of the map that it gives.
struct MapLayer {
    Pixels image;
    TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
    std::size_t first = 0, last = 4; ///< channels
    bool occlusion = false;          ///< its factor mixes with white
};

std::size_t wrapped(std::int64_t i, std::size_t count, TextureWrap wrap) {
    const auto n = static_cast<std::int64_t>(count);
    if (wrap == TextureWrap::clamp) return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, n - 1));
    const std::int64_t period = wrap == TextureWrap::mirror ? 2 * n : n;
    i = (i % period + period) % period;
    return static_cast<std::size_t>(i < n ? i : period - 1 - i);
}

Byte4 texel(const MapLayer& t, std::int64_t x, std::int64_t y) {
    const std::size_t at =
        4 * (wrapped(y, t.image.height, t.wrap_v) * t.image.width + wrapped(x, t.image.width, t.wrap_u));
    return {t.image.rgba[at], t.image.rgba[at + 1], t.image.rgba[at + 2], t.image.rgba[at + 3]};
}

Texel decoded(const Byte4& bytes, PixelKind kind) {
    Texel out{};
    for (std::size_t c = 0; c < 4; ++c)
        out[c] = kind == PixelKind::normals && c < 3   ? static_cast<float>(bytes[c]) / 127.5F - 1
                 : kind == PixelKind::colours && c < 3 ? linear_of(bytes[c])
                                                       : static_cast<float>(bytes[c]) / 255;
    return out;
}

std::uint8_t byte_of(float x) { return static_cast<std::uint8_t>(std::clamp(x * 255 + 0.5F, 0.0F, 255.0F)); }

Byte4 encoded_texel(const Texel& value, PixelKind kind) {
    Byte4 out{};
    const float l = std::sqrt(value[0] * value[0] + value[1] * value[1] + value[2] * value[2]);
    const auto along = [&](std::size_t c) { return l > 0 ? value[c] / l : c == 2 ? 1.0F : 0.0F; };
    for (std::size_t c = 0; c < 4; ++c)
        out[c] = kind == PixelKind::normals && c < 3   ? byte_of((along(c) + 1) / 2)
                 : kind == PixelKind::colours && c < 3 ? srgb_of(value[c])
                                                       : byte_of(value[c]);
    return out;
}

/// The decoded value at a point, in texels, bilinear.
Texel mixed(const MapLayer& t, double x, double y, PixelKind kind) {
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    const auto fx = static_cast<float>(x - 0.5 - left), fy = static_cast<float>(y - 0.5 - top);
    Texel sum{};
    for (int i = 0; i < 4; ++i) {
        const float weight = (i % 2 ? fx : 1 - fx) * (i / 2 ? fy : 1 - fy);
        const Texel one = decoded(
            texel(t, static_cast<std::int64_t>(left) + i % 2, static_cast<std::int64_t>(top) + i / 2), kind);
        for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * one[c];
    }
    return sum;
}

PixelKind kind_of_map(AtlasMap map) {
    return map == AtlasMap::normal    ? PixelKind::normals
           : map == AtlasMap::surface ? PixelKind::numbers
                                      : PixelKind::colours;
}

float ratio(double own, double common) { return common > 0 ? static_cast<float>(own / common) : 1.0F; }

/// The factors of a tile relative to the common ones, by channel.
Texel ratios(const io::AtlasMaterial& own, const io::AtlasMaterial& common, AtlasMap map) {
    Texel out{1, 1, 1, 1};
    if (map == AtlasMap::base)
        for (std::size_t c = 0; c < 4; ++c) out[c] = ratio(own.colour[c], common.colour[c]);
    if (map == AtlasMap::emission)
        for (std::size_t c = 0; c < 3; ++c) out[c] = ratio(own.emissive[c], common.emissive[c]);
    if (map == AtlasMap::normal) out[0] = out[1] = ratio(own.normal_scale, common.normal_scale);
    if (map == AtlasMap::surface)
        out = {ratio(own.occlusion_strength, common.occlusion_strength),
               ratio(own.roughness, common.roughness), ratio(own.metalness, common.metalness), 1};
    return out;
}

/// The textures of a map, with the channels that they give.
struct LayerTexture {
    const std::optional<io::AtlasTexture>* texture;
    std::size_t first, last;
    bool occlusion;
};
std::vector<LayerTexture> layers_of(const io::AtlasMaterial& look, AtlasMap map) {
    if (map == AtlasMap::base) return {{&look.base, 0, 4, false}};
    if (map == AtlasMap::normal) return {{&look.normal, 0, 3, false}};
    if (map == AtlasMap::emission) return {{&look.emission, 0, 3, false}};
    return {{&look.rough, 1, 3, false}, {&look.occlusion, 0, 1, true}};
}

/// Draws one tile into a map.
class TileDrawer {
  public:
    TileDrawer(const AtlasPlan& plan, AtlasMap map, std::size_t tile, const ImageGetter& image)
        : plan_(plan), tile_(plan.layout.tiles[tile]), kind_(kind_of_map(map)), map_(map),
          divisor_(plan.divisor(map)), ratios_(ratios(*plan.looks[tile], plan.common, map)) {
        for (const LayerTexture& layer : layers_of(*plan.looks[tile], map))
            if (*layer.texture)
                layers_.push_back({scaled(image(tile, **layer.texture)), (*layer.texture)->sampling.wrap_u,
                                   (*layer.texture)->sampling.wrap_v, layer.first, layer.last,
                                   layer.occlusion});
    }

    void draw(Pixels& out) const {
        const std::size_t margin = plan_.gutter / divisor_, left = tile_.x / divisor_ - margin,
                          right = (tile_.x + tile_.width) / divisor_ + margin,
                          top = tile_.y / divisor_ - margin,
                          bottom = (tile_.y + tile_.height) / divisor_ + margin;
        parallel_for(
            bottom - top,
            [&](std::size_t row) {
                for (std::size_t x = left; x < right; ++x) {
                    const Byte4 bytes = value(x, top + row);
                    std::copy(bytes.begin(), bytes.end(), &out.rgba[4 * ((top + row) * out.width + x)]);
                }
            },
            16);
    }

  private:
    Pixels scaled(Pixels image) const {
        const auto target = [&](std::size_t axis, std::size_t own) {
            return std::min(own, std::max<std::size_t>(1, tile_.side(axis) / divisor_));
        };
        const std::size_t w = target(0, image.width), h = target(1, image.height);
        if (w == image.width && h == image.height) return image;
        return io::resized_image(image, w, h, kind_, map_ == AtlasMap::base && !plan_.opaque);
    }

    Byte4 value(std::size_t x, std::size_t y) const {
        Byte4 out = plain_value();
        for (const MapLayer& layer : layers_) {
            const Byte4 own = sampled(layer, x, y);
            std::copy(own.begin() + layer.first, own.begin() + layer.last, out.begin() + layer.first);
        }
        if (map_ != AtlasMap::base || plan_.opaque) out[3] = 255;
        return out;
    }

    /// The texel of a material without the texture.
    Byte4 plain_value() const {
        if (map_ == AtlasMap::normal) return {128, 128, 255, 255};
        Texel white = ratios_;
        if (map_ == AtlasMap::surface) white[0] = 1; // not occluded
        return encoded_texel(white, kind_);
    }

    Byte4 sampled(const MapLayer& layer, std::size_t x, std::size_t y) const {
        const auto d = static_cast<std::int64_t>(divisor_);
        const std::int64_t column = static_cast<std::int64_t>(x) + tile_.left / d -
                                    static_cast<std::int64_t>(tile_.x) / d,
                           row = static_cast<std::int64_t>(y) + tile_.top / d -
                                 static_cast<std::int64_t>(tile_.y) / d;
        const bool exact =
            layer.image.width * divisor_ == tile_.side(0) && layer.image.height * divisor_ == tile_.side(1);
        const bool plain = std::all_of(ratios_.begin() + layer.first, ratios_.begin() + layer.last,
                                       [](float r) { return r == 1; });
        if (exact && plain) return texel(layer, column, row);
        const auto at = [&](std::int64_t i, std::size_t count, std::size_t axis) {
            return (static_cast<double>(i) + 0.5) * static_cast<double>(divisor_) /
                   static_cast<double>(tile_.side(axis)) * static_cast<double>(count);
        };
        Texel value =
            exact ? decoded(texel(layer, column, row), kind_)
                  : mixed(layer, at(column, layer.image.width, 0), at(row, layer.image.height, 1), kind_);
        for (std::size_t c = layer.first; c < layer.last; ++c)
            value[c] = layer.occlusion ? 1 + ratios_[c] * (value[c] - 1) : value[c] * ratios_[c];
        return encoded_texel(value, kind_);
    }

    const AtlasPlan& plan_;
    const AtlasTile& tile_;
    PixelKind kind_;
    AtlasMap map_;
    std::size_t divisor_;
    Texel ratios_;
    std::vector<MapLayer> layers_;
};

} // namespace

bool AtlasPlan::has_textures(AtlasMap map) const {
    for (const io::AtlasMaterial* look : looks)
        for (const LayerTexture& layer : layers_of(*look, map))
            if (*layer.texture) return true;
    return false;
}

bool AtlasPlan::needs(AtlasMap map) const {
    return has_textures(map) || std::any_of(looks.begin(), looks.end(), [&](const io::AtlasMaterial* look) {
               return map != AtlasMap::normal && ratios(*look, common, map) != Texel{1, 1, 1, 1};
           });
}

std::size_t AtlasPlan::divisor(AtlasMap map) const {
    std::size_t least = gutter;
    for (std::size_t i = 0; i < looks.size(); ++i)
        for (const LayerTexture& layer : layers_of(*looks[i], map)) {
            if (!*layer.texture) continue;
            const AtlasTile& tile = layout.tiles[i];
            const auto& [width, height] = (*layer.texture)->size;
            const std::size_t ratio = std::min(tile.image_width / std::max<std::size_t>(1, width),
                                               tile.image_height / std::max<std::size_t>(1, height));
            least = std::min(least, std::bit_floor(std::max<std::size_t>(1, ratio)));
        }
    return least;
}

void find_common_factors(AtlasPlan& plan) {
    io::AtlasMaterial& c = plan.common;
    c = *plan.looks.front();
    bool occluded = false, bumpy = false;
    for (const io::AtlasMaterial* look : plan.looks) {
        for (std::size_t i = 0; i < 4; ++i) c.colour[i] = std::max(c.colour[i], look->colour[i]);
        for (std::size_t i = 0; i < 3; ++i) c.emissive[i] = std::max(c.emissive[i], look->emissive[i]);
        c.metalness = std::max(c.metalness, look->metalness);
        c.roughness = std::max(c.roughness, look->roughness);
        const auto join = [](bool has, bool& any, double own, double& common) {
            if (has) common = any ? std::max(common, own) : own;
            any |= has;
        };
        join(look->occlusion.has_value(), occluded, look->occlusion_strength, c.occlusion_strength);
        join(look->normal.has_value(), bumpy, look->normal_scale, c.normal_scale);
    }
}

Pixels draw_map(const AtlasPlan& plan, AtlasMap map, const ImageGetter& image) {
    const std::size_t d = plan.divisor(map);
    Pixels out{plan.layout.width / d, plan.layout.height / d, {}, false};
    out.rgba.resize(4 * out.width * out.height);
    const Byte4 empty = map == AtlasMap::normal ? Byte4{128, 128, 255, 255} : Byte4{0, 0, 0, 255};
    for (std::size_t i = 0; i < out.rgba.size(); ++i) out.rgba[i] = empty[i % 4];
    for (std::size_t i = 0; i < plan.layout.tiles.size(); ++i) TileDrawer(plan, map, i, image).draw(out);
    return out;
}

} // namespace facetmill::textures_stage

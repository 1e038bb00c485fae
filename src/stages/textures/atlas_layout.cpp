#include "stages/textures/atlas_layout.hpp"

#include "geometry/nest/nest.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace facetmill::textures_stage {

namespace {

constexpr std::size_t least_side = 4;      ///< textures are not halved below
constexpr std::size_t most_widths = 64;    ///< that are tried
constexpr std::size_t most_places = 20000; ///< searched for all widths together

/// Sets the texels that faces use, in multiples of the gutter, so that maps of half the size fit too.
void fit_texels(AtlasTile& tile, std::size_t gutter) {
    if (tile.image_width == 0 || tile.extent.low[0] > tile.extent.high[0]) { // no texture, or no faces
        tile.left = tile.top = 0;
        tile.width = tile.height = gutter;
        return;
    }
    const auto step = static_cast<double>(gutter);
    const auto first = [&](std::size_t axis) {
        return std::floor(tile.extent.low[axis] * static_cast<double>(tile.side(axis)) / step) * step;
    };
    const auto length = [&](std::size_t axis) {
        const double end =
            std::ceil(tile.extent.high[axis] * static_cast<double>(tile.side(axis)) / step) * step;
        return static_cast<std::size_t>(std::max(end - first(axis), step));
    };
    tile.left = static_cast<std::int64_t>(first(0));
    tile.top = static_cast<std::int64_t>(first(1));
    tile.width = length(0);
    tile.height = length(1);
}

/// Texels per area of the faces.
double density(const AtlasTile& tile) {
    const double texels =
        tile.extent.uv_area * static_cast<double>(tile.side(0)) * static_cast<double>(tile.side(1));
    return tile.extent.world_area > 0 ? texels / tile.extent.world_area : texels > 0 ? HUGE_VAL : 0;
}

/// The atlas if the tiles fit into this size.
std::optional<AtlasLayout> packed(const std::vector<AtlasTile>& tiles, std::size_t width, std::size_t limit,
                                  std::size_t gutter) {
    std::vector<NestRectangle> rectangles;
    rectangles.reserve(tiles.size());
    for (const AtlasTile& tile : tiles)
        rectangles.push_back(
            {static_cast<double>(tile.width + 2 * gutter), static_cast<double>(tile.height + 2 * gutter)});
    NestSettings settings;
    settings.width = static_cast<double>(width);
    settings.depth = static_cast<double>(limit);
    settings.turns = false;
    settings.plates = 1;
    const auto places = nest(rectangles, settings);
    AtlasLayout out{tiles, 0, 0};
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (!places[i]) return {};
        AtlasTile& tile = out.tiles[i];
        tile.x = static_cast<std::size_t>(places[i]->x) + gutter;
        tile.y = static_cast<std::size_t>(places[i]->y) + gutter;
        out.width = std::max(out.width, tile.x + tile.width + gutter);
        out.height = std::max(out.height, tile.y + tile.height + gutter);
    }
    return out;
}

/// Halves the densest texture, or one that does not fit alone. Returns false if all are small.
bool halve(std::vector<AtlasTile>& tiles, std::size_t limit, std::size_t gutter) {
    AtlasTile* densest = nullptr;
    const auto rank = [&](const AtlasTile& tile) {
        const bool too_large = std::max(tile.width, tile.height) + 2 * gutter > limit;
        return std::make_tuple(too_large, density(tile), tile.width * tile.height);
    };
    for (AtlasTile& tile : tiles) {
        if (tile.image_width == 0 || std::max(tile.side(0), tile.side(1)) <= least_side) continue;
        if (!densest || rank(tile) > rank(*densest)) densest = &tile;
    }
    if (!densest) return false;
    ++densest->halvings;
    fit_texels(*densest, gutter);
    return true;
}

} // namespace

std::size_t AtlasTile::side(std::size_t axis) const {
    const std::size_t whole = axis == 0 ? image_width : image_height;
    return std::max<std::size_t>(1, (whole + (std::size_t{1} << halvings) - 1) >> halvings);
}

Uv AtlasTile::place(const Uv& uv) const {
    if (image_width == 0)
        return {static_cast<double>(x) + static_cast<double>(width) / 2,
                static_cast<double>(y) + static_cast<double>(height) / 2};
    return {static_cast<double>(x) + uv[0] * static_cast<double>(side(0)) - static_cast<double>(left),
            static_cast<double>(y) + uv[1] * static_cast<double>(side(1)) - static_cast<double>(top)};
}

std::optional<AtlasLayout> lay_out(std::vector<AtlasTile> tiles, std::size_t limit, std::size_t gutter) {
    for (AtlasTile& tile : tiles) fit_texels(tile, gutter);
    limit = limit / gutter * gutter;
    std::optional<AtlasLayout> best;
    while (!(best = packed(tiles, limit, limit, gutter)))
        if (!halve(tiles, limit, gutter)) return {};
    std::size_t narrowest = 0, whole = 0;
    for (const AtlasTile& tile : tiles) {
        narrowest = std::max(narrowest, tile.width + 2 * gutter);
        whole += tile.width + 2 * gutter;
    }
    const std::size_t widest = std::min(limit, whole);
    const auto rank = [](const AtlasLayout& layout) {
        return std::make_tuple(layout.width * layout.height, std::max(layout.width, layout.height));
    };
    const std::size_t widths = std::clamp<std::size_t>(most_places / tiles.size(), 2, most_widths);
    for (std::size_t i = 0; i < widths; ++i) {
        const std::size_t width = narrowest + (widest - narrowest) * i / (widths - 1);
        auto other = packed(tiles, width / gutter * gutter, limit, gutter);
        if (other && rank(*other) < rank(*best)) best = std::move(other);
    }
    return best;
}

} // namespace facetmill::textures_stage

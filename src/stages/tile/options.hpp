#pragma once
// The options of tile, and the grid and the pegs that they give.

#include "geometry/pegs/pegs.hpp"
#include "stage/stage.hpp"

namespace facetmill::tile_stage {

struct PegOptions {
    Length diameter;
    PegKind kind = PegKind::pegs;
    std::optional<Length> length, clearance, wall;
    std::int64_t count = 2;
};

struct TileOptions {
    std::vector<Length> size, fit;
    std::optional<std::string> axes;
    std::vector<Length> origin;
    std::optional<PegOptions> pegs;
    bool cap = false;
    std::string cap_material = "cap";

    bool fits() const { return !fit.empty(); }
    bool caps() const { return cap || fits() || pegs; }
    std::string cut_axes() const { return axes.value_or(fits() ? "xyz" : "xy"); }
};

void declare_tile_options(Declare<TileOptions>& d);
/// Checks lists and sizes, which the declaration cannot express.
void verify_tile(const TileOptions& o, const Value& given, Problems& problems);

/// The pegs in world units, if any.
[[nodiscard]] std::optional<PegSettings> pegs_of(const TileOptions& o, const Scene& scene, Context& context);
/// The grid of `size`. Throws E-TILE for a size of 0.
[[nodiscard]] std::vector<TileAxis> grid_of(const TileOptions& o, const Scene& scene, Context& context);
/// The grid of `fit` for a part with this box: the fewest tiles, which begin at the box and are equally long
/// together with their pegs. Axes along which the part fits are left out. Throws E-TILE if the pegs leave no
/// room for a tile.
[[nodiscard]] std::vector<TileAxis> fitted_grid(const TileOptions& o, const Box& box, double protrusion,
                                                const Scene& scene, Context& context);

} // namespace facetmill::tile_stage

#include "stages/tile/options.hpp"

#include "mesh/float32_ulp.hpp"
#include "options/mark_at.hpp"
#include "stage/context.hpp"
#include "stage/options/cap.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::tile_stage {

namespace {

void declare_pegs(Declare<PegOptions>& d) {
    d.option("diameter", &PegOptions::diameter, "The diameter of pegs, dowels or magnets.")
        .above(0)
        .required()
        .primary();
    d.choice<PegKind>("kind", &PegOptions::kind,
                      {{"pegs", PegKind::pegs, "a peg on the lower tile, and a hole in the upper tile"},
                       {"dowels", PegKind::dowels, "a hole in both tiles, each for half of a separate dowel"},
                       {"magnets", PegKind::magnets, "a hole in both tiles, each for a whole magnet"}},
                      "What joins two tiles.");
    d.option("length", &PegOptions::length,
             "The length of a peg outside its tile, or the length of a dowel or magnet. Default: the "
             "diameter, or twice the diameter for dowels.")
        .above(0);
    d.option("clearance", &PegOptions::clearance,
             "The gap around a peg, dowel or magnet, on each side and at the end. Default: 1/20 of the "
             "diameter.")
        .at_least(0);
    d.option("wall", &PegOptions::wall,
             "The minimum thickness of the material around a hole. Default: half of the diameter.")
        .at_least(0);
    d.option("count", &PegOptions::count,
             "The maximum number of pegs, dowels or magnets for each pair of tiles.")
        .between(1, 100);
}

/// Checks a list of lengths: one, or one for each axis.
void verify_lengths(const char* name, const std::vector<Length>& lengths, std::size_t axes,
                    const Value* given, Problems& problems, const Mark& mark) {
    if (lengths.empty())
        problems.add(mark, "E-TILE", fmt::format("tile: '{}' is an empty list", name),
                     "give one size, or one for each axis");
    for (const Length& size : lengths)
        if (!(size.amount > 0) && !(given && given->deferred))
            problems.add(mark, "E-TILE", fmt::format("tile: '{}' must be above 0, found {}", name, size.text),
                         fmt::format("write, for example, {}: 200mm", name));
    if (lengths.size() > 1 && lengths.size() != axes)
        problems.add(mark, "E-TILE", fmt::format("tile: {} sizes for {} axes", lengths.size(), axes),
                     "give one size, or one for each axis");
}

/// The lengths of `size` or `fit` by axis.
double length_along(const std::vector<Length>& lengths, std::size_t i, const char* name, const Scene& scene,
                    Context& context) {
    const double length = context.resolve(lengths[lengths.size() > 1 ? i : 0], scene, name);
    if (!(length > 0))
        throw Error(ErrorKind::stage, "E-TILE", "the size of the tiles is 0 in this scene",
                    "the bounding box has no extent: give a length in scene units");
    return length;
}

} // namespace

void declare_tile_options(Declare<TileOptions>& d) {
    d.option("size", &TileOptions::size, "The edge length of the tiles: one length, or one for each axis.")
        .primary();
    d.option("fit", &TileOptions::fit,
             "Cuts each part into the fewest tiles that fit into a box of this size, such as the bed of a "
             "printer. Give one length, or one for each axis. The grid begins at the part's bounding box. "
             "Tiles are equally long and numbered from bottom to top. Turns cap on.")
        .also_called("bed build_volume plate", "(fit: [200mm, 200mm, 200mm])");
    d.option("axes", &TileOptions::axes,
             "The axes along which the grid cuts: any of x, y and z. Default: xy for size, xyz for fit.");
    d.option(
        "origin", &TileOptions::origin,
        "A corner of the grid: one length for each axis. Default: 0. The grid extends in both directions.");
    d.group("pegs", &TileOptions::pegs,
            "Joins neighbouring tiles of a closed part by pegs, dowels or magnets. Turns cap on.",
            declare_pegs)
        .also_called("connectors dowels magnets pins", "(pegs: 6mm)");
    declare_cap(d, &TileOptions::cap, &TileOptions::cap_material);
    d.exactly_one({"size", "fit"});
    d.at_most_one({"fit", "origin"});
}

void verify_tile(const TileOptions& o, const Value& given, Problems& problems) {
    const std::string cut = o.cut_axes();
    const auto axis = [&](char c) {
        return std::string_view("xyz").find(c) != std::string_view::npos &&
               std::count(cut.begin(), cut.end(), c) == 1;
    };
    if (cut.empty() || !std::all_of(cut.begin(), cut.end(), axis))
        problems.add(mark_at(given, "axes"), "E-TILE",
                     fmt::format("tile: 'axes' accepts each of x, y, z at most once, found '{}'", cut),
                     "for example axes: xy");
    const Value* fit = given.is_map() ? given.find("fit") : nullptr;
    if (fit)
        verify_lengths("fit", o.fit, cut.size(), fit, problems, mark_at(given, "fit"));
    else
        verify_lengths("size", o.size, cut.size(), given.is_map() ? given.find("size") : &given, problems,
                       mark_at(given, "size"));
    if (!o.origin.empty() && o.origin.size() != cut.size())
        problems.add(mark_at(given, "origin"), "E-TILE",
                     fmt::format("tile: {} origins for {} axes", o.origin.size(), cut.size()),
                     "give one for each axis");
    if (given.is_map() && given.find("cap") && !o.cap && o.caps())
        problems.add(mark_at(given, "cap"), "E-CONFLICT", "tile: 'cap: false' excludes fit and pegs",
                     "remove cap: both need closed tiles");
}

std::optional<PegSettings> pegs_of(const TileOptions& o, const Scene& scene, Context& context) {
    if (!o.pegs) return {};
    const PegOptions& given = *o.pegs;
    PegSettings pegs;
    pegs.kind = given.kind;
    pegs.count = static_cast<std::size_t>(given.count);
    pegs.diameter = context.resolve(given.diameter, scene, "pegs.diameter");
    const auto resolved = [&](const std::optional<Length>& length, const char* name, double share) {
        return length ? context.resolve(*length, scene, name) : share * pegs.diameter;
    };
    pegs.length = resolved(given.length, "pegs.length", pegs.kind == PegKind::dowels ? 2 : 1);
    pegs.clearance = resolved(given.clearance, "pegs.clearance", 0.05);
    pegs.wall = resolved(given.wall, "pegs.wall", 0.5);
    if (!(pegs.diameter > 0) || !(pegs.length > 0))
        throw Error(ErrorKind::stage, "E-TILE", "tile: the size of the pegs is 0 in this scene",
                    "the bounding box has no extent: give lengths in scene units");
    return pegs;
}

std::vector<TileAxis> grid_of(const TileOptions& o, const Scene& scene, Context& context) {
    std::vector<TileAxis> axes;
    const std::string cut = o.cut_axes();
    for (std::size_t i = 0; i < cut.size(); ++i) {
        const double size = length_along(o.size, i, "size", scene, context);
        axes.push_back({static_cast<std::size_t>(cut[i] - 'x'), size,
                        o.origin.empty() ? 0 : context.resolve(o.origin[i], scene, "origin")});
    }
    return axes;
}

std::vector<TileAxis> fitted_grid(const TileOptions& o, const Box& box, double protrusion, const Scene& scene,
                                  Context& context) {
    std::vector<TileAxis> axes;
    const std::string cut = o.cut_axes();
    // Rounding to 32-bit floats in the input can make a part too large by one step. It is not cut for that.
    const double rounding = float32_ulp(box);
    for (std::size_t i = 0; i < cut.size(); ++i) {
        const auto axis = static_cast<std::size_t>(cut[i] - 'x');
        const double bed = length_along(o.fit, i, "fit", scene, context);
        const double extent = box.extent()[axis];
        if (!(extent > bed + rounding)) continue;
        if (!(bed > protrusion))
            throw Error(ErrorKind::stage, "E-TILE",
                        fmt::format("tile: pegs of length {:.6g} leave no room for a tile in {:.6g}",
                                    protrusion, bed),
                        "use shorter pegs, or dowels");
        // All tiles except the last have pegs, so n tiles hold n * bed - (n - 1) * protrusion.
        const double n = std::ceil((extent - rounding - protrusion) / (bed - protrusion));
        if (!(n < 1e6))
            throw Error(ErrorKind::limit, "E-TILE",
                        fmt::format("tile: fit would give {:.3g} rows of tiles along one axis", n),
                        "check the unit of fit");
        const double size = (extent - protrusion) / n;
        axes.push_back({axis, size, box.min[axis], static_cast<std::int64_t>(n)});
    }
    return axes;
}

} // namespace facetmill::tile_stage

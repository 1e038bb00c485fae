#include "geometry/tile/tile.hpp"
#include "options/mark_at.hpp"
#include "stage/bind_pose.hpp"
#include "stage/context.hpp"
#include "stage/options/cap.hpp"
#include "stage/stage.hpp"
#include "stages/tile/help.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::tile_stage {

namespace {

struct ReportedTile {
    std::string part;
    std::array<std::optional<std::int64_t>, 3> cell{}; ///< the cell by axis, for the cut axes
    std::size_t faces = 0;
};

struct TileReport {
    std::vector<ReportedTile> tiles;
    std::size_t cut_faces = 0, cap_faces = 0, open_contours = 0;
};

struct TileOptions {
    std::vector<Length> size;
    std::string axes = "xy";
    std::vector<Length> origin;
    bool cap = false;
    std::string cap_material = "cap";
};

void declare(Declare<TileOptions>& d) {
    d.option("size", &TileOptions::size, "The edge length of the tiles: one length, or one for each axis.")
        .required()
        .primary();
    d.option("axes", &TileOptions::axes, "The axes along which the grid cuts: any of x, y and z.");
    d.option(
        "origin", &TileOptions::origin,
        "A corner of the grid: one length for each axis. Default: 0. The grid extends in both directions.");
    declare_cap(d, &TileOptions::cap, &TileOptions::cap_material);
}

std::vector<TileAxis> axes_of(const TileOptions& o, const Scene& scene, Context& context) {
    std::vector<TileAxis> axes;
    for (std::size_t i = 0; i < o.axes.size(); ++i) {
        const Length& size = o.size[o.size.size() > 1 ? i : 0];
        const double edge = context.resolve(size, scene, "size");
        if (!(edge > 0))
            throw Error(ErrorKind::stage, "E-TILE", "the size of the tiles is 0 in this scene",
                        "the bounding box has no extent: give a length in scene units");
        axes.push_back({static_cast<std::size_t>(o.axes[i] - 'x'), edge,
                        o.origin.empty() ? 0 : context.resolve(o.origin[i], scene, "origin")});
    }
    return axes;
}

void declare_tile(DeclareFields<ReportedTile>& d) {
    d.field("part", &ReportedTile::part, "The name of the tile.");
    for (std::size_t axis = 0; axis < 3; ++axis)
        d.field(
             std::string("tile_") + "xyz"[axis], [axis](const ReportedTile& t) { return t.cell[axis]; },
             "The index along this axis.")
            .only_when("this axis is cut");
    d.field("faces", &ReportedTile::faces, "The number of faces.");
}

void declare_report(DeclareFields<TileReport>& d) {
    d.list("tiles", &TileReport::tiles, "Each tile with faces or points.", declare_tile);
    d.field("cut_faces", &TileReport::cut_faces, "Faces that were cut.");
    d.field("cap_faces", &TileReport::cap_faces, "Faces of caps.");
    d.field("open_contours", &TileReport::open_contours,
            "Contours that were not capped because they are open.");
}

/// The name of a tile, such as "body.x0.y-1".
std::string name_of(const Part& part, const Tile& tile, const std::vector<TileAxis>& axes) {
    std::string name = part.name;
    for (const TileAxis& a : axes) name += fmt::format(".{}{}", "xyz"[a.axis], tile.cell[a.axis]);
    return name;
}

class TileRun {
  public:
    TileRun(const TileSettings& settings, Context& context) : context_(context), settings_(settings) {}

    Scene run(Scene scene, const std::string& cap_material, TileReport& report) {
        if (settings_.clip.cap) set_cap(settings_.clip, scene, cap_material);
        std::vector<Part> parts;
        std::vector<const Part*> cut;
        context_.for_each_part(scene, [&](Part& part) { cut.push_back(&part); });
        auto next = cut.begin(); // parts are in the scene's order
        for (Part& part : scene.parts) {
            if (next == cut.end() || *next != &part) {
                parts.push_back(std::move(part));
                continue;
            }
            ++next;
            cut_part(part, parts, report);
        }
        scene.parts = std::move(parts);
        if (report.cap_faces > 0) add_material(scene, cap_material);
        return scene;
    }

  private:
    void cut_part(Part& part, std::vector<Part>& parts, TileReport& report) {
        settings_.to_world = part.transform;
        settings_.clip.memory = part.cuts ? *part.cuts : CutMemory{};
        TileResult r = tile(std::move(part.mesh), settings_);
        part.mesh = {};
        warn_of_open("tile", part, r.open, context_);
        context_.attribute_changes(part, r.changes);
        report.cut_faces += r.cut_faces;
        report.cap_faces += r.cap_faces;
        report.open_contours += r.open.size();
        if (r.tiles.empty())
            context_.warn("W-TILE-NOTHING",
                          fmt::format("tile: part '{}' is empty and gives no tile", part.name));
        const auto cuts = std::make_shared<const CutMemory>(std::move(r.memory));
        for (Tile& t : r.tiles) {
            Part& piece = parts.emplace_back(part);
            piece.name = name_of(part, t, settings_.axes);
            piece.mesh = std::move(t.mesh);
            piece.cuts = cuts;
            auto& entry = report.tiles.emplace_back();
            entry.part = piece.name;
            for (const TileAxis& a : settings_.axes) entry.cell[a.axis] = t.cell[a.axis];
            entry.faces = piece.mesh.face_count();
        }
    }

    Context& context_;
    TileSettings settings_;
};

/// Replaces each selected part by its tiles, named after part and cell ("body.x0.y-1"). settings: shared by
/// all parts, except transform, memory and the caps' primitive. Warns about open contours (W-CAP-OPEN) and
/// parts without faces (W-TILE-NOTHING).
Scene tile_parts(Scene scene, const TileSettings& settings, const std::string& cap_material, Context& context,
                 TileReport& report) {
    return TileRun(settings, context).run(std::move(scene), cap_material, report);
}

Scene run(Scene scene, const TileOptions& o, Context& context, TileReport& report) {
    warn_of_bind_pose(scene, context);
    TileSettings settings;
    settings.axes = axes_of(o, scene, context);
    settings.clip.snap = true;
    settings.clip.cap = o.cap;
    return tile_parts(std::move(scene), settings, o.cap_material, context, report);
}

struct TileStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        const auto axis = [&](char c) {
            return std::string_view("xyz").find(c) != std::string_view::npos &&
                   std::count(o.axes.begin(), o.axes.end(), c) == 1;
        };
        if (o.axes.empty() || !std::all_of(o.axes.begin(), o.axes.end(), axis))
            problems.add(mark_at(given, "axes"), "E-TILE",
                         fmt::format("tile: 'axes' accepts each of x, y, z at most once, found '{}'", o.axes),
                         "for example axes: xy");
        const Value* sizes = given.is_map() ? given.find("size") : &given;
        if (o.size.empty())
            problems.add(mark_at(given, "size"), "E-TILE", "tile: 'size' is an empty list",
                         "give one size, or one for each axis");
        for (const Length& size : o.size)
            if (!(size.amount > 0) && !(sizes && sizes->deferred))
                problems.add(mark_at(given, "size"), "E-TILE",
                             fmt::format("tile: 'size' must be above 0, found {}", size.text));
        if (o.size.size() > 1 && o.size.size() != o.axes.size())
            problems.add(mark_at(given, "size"), "E-TILE",
                         fmt::format("tile: {} sizes for {} axes", o.size.size(), o.axes.size()),
                         "give one size, or one for each axis");
        if (!o.origin.empty() && o.origin.size() != o.axes.size())
            problems.add(mark_at(given, "origin"), "E-TILE",
                         fmt::format("tile: {} origins for {} axes", o.origin.size(), o.axes.size()),
                         "give one for each axis");
    }
};

const RegisterStage registered =
    make_stage<TileStage>({.name = "tile",
                           .also_called = "chunk tiler",
                           .about = help::tile::about,
                           .details = help::tile::details,
                           .examples = {"tile: 100", "tile: {size: 100, axes: xy, origin: [0, 0]}",
                                        "tile: {size: [10mm, 20mm, 5mm], axes: xyz, cap: true}"},
                           .crossing_faces = CrossingFacePolicy::fill},
                          declare, declare_report);

} // namespace

} // namespace facetmill::tile_stage

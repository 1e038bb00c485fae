#include "geometry/triangulate/crossing_faces.hpp"
#include "options/mark_at.hpp"
#include "stage/bind_pose.hpp"
#include "stage/options/footprint.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/read_recorded.hpp"
#include "stage/stage.hpp"
#include "stages/volume/help.hpp"
#include "stages/volume/report.hpp"

#include "base/text/readable_numbers.hpp"

#include <fmt/format.h>

namespace facetmill::volume_stage {

namespace {

struct VolumeOptions {
    std::optional<Length> level;
    std::optional<PathText> with;
    std::optional<FootprintOption> footprint;
    ViewAxis axis = ViewAxis::up;
};

void declare(Declare<VolumeOptions>& d) {
    d.option("level", &VolumeOptions::level, "The height to compare with, along the axis.")
        .also_called("height elevation datum plane z to")
        .primary();
    d.option("with", &VolumeOptions::with,
             "The mesh file of the surface to compare with, instead of a level.")
        .also_called(with_synonyms)
        .also_called("design reference");
    d.option("footprint", &VolumeOptions::footprint,
             "The polygon that limits the comparison: a GeoJSON, WKT or DXF file, WKT text, a ring of "
             "points, or a list of rings, as for crop.")
        .also_called("polygon outline boundary inside");
    declare_view_axis(d, &VolumeOptions::axis);
}

void verify_reference(const VolumeOptions& o, const Value& given, Problems& problems) {
    if (o.level.has_value() == o.with.has_value())
        problems.add(o.level ? mark_at(given, "with") : given.mark, "E-VOLUME",
                     o.level ? "volume: 'level' and 'with' are both given, but there is only one reference"
                             : "volume: the reference is missing",
                     o.level ? "remove one of them"
                             : "give a level (volume: 425), or another surface (volume: {with: design.ply}); "
                               "measure gives the volume of solids");
    if (o.level && o.level->kind == Length::Kind::percent)
        problems.add(mark_at(given, "level"), "E-VOLUME", "volume: a level cannot be a percentage",
                     "give a height in scene units, or with a unit");
}

/// Refuses a surface that lies above itself. name: "the scene".
void refuse_sheets(Cover cover, const std::optional<Vec3>& at, const std::string& name) {
    if (cover != Cover::several) return;
    throw Error(ErrorKind::stage, "E-VOLUME",
                fmt::format("volume: {} has sheets above each other, for example at {}", name,
                            at ? readable(*at) : "unknown places"),
                "select the ground with only; if it is a single surface that overhangs, use orient first");
}

std::string bounds_text(const Scene& scene, std::size_t axis, const Context& context, FlatBounds& all) {
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) all.add(bounds_of(part, axis));
    return all.text();
}

/// Refuses surfaces and footprints that miss each other.
void refuse_disjoint(const VolumeReport& report, const std::optional<Footprint>& footprint,
                     const Scene& scene, std::size_t axis, const Context& context) {
    const VolumeResult& r = report.result;
    const bool misses = report.is_solid() ? false : !(r.compared > 0);
    if (!misses) return;
    FlatBounds bounds;
    const std::string mesh = bounds_text(scene, axis, context, bounds);
    if (footprint && !(r.missing < r.footprint))
        throw Error(ErrorKind::stage, "E-VOLUME",
                    fmt::format("volume: the scene has no surface in the footprint: the footprint reaches "
                                "from {}, the scene from {}",
                                bounds_of(*footprint).text(), mesh),
                    hint_for_missed(bounds_of(*footprint), bounds));
    throw Error(ErrorKind::stage, "E-VOLUME",
                report.level ? "volume: the scene has no surface when seen along the axis"
                             : "volume: the other surface is not above or below the scene",
                "check the axis, and that both have the same origin; facetmill info prints the bounds");
}

void check_covers(const VolumeReport& report, const VolumeOptions& o) {
    const VolumeResult& r = report.result;
    refuse_sheets(r.cover, r.doubled, "the scene");
    if (!o.with) return;
    refuse_sheets(r.other_cover, r.other_doubled, fmt::format("'{}'", o.with->text));
    if (r.cover == Cover::solid || r.other_cover == Cover::solid)
        throw Error(ErrorKind::stage, "E-VOLUME",
                    fmt::format("volume: {} is a closed solid, but only open surfaces can be compared",
                                r.cover == Cover::solid ? "the scene" : fmt::format("'{}'", o.with->text)),
                    "compare the solid with a level, or use combine and measure for two solids");
}

/// The surface of the selected parts, in world space.
Surface selected_surface(const Scene& scene, const Context& context) {
    std::vector<const Part*> parts;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) parts.push_back(&part);
    return surface_of(parts, filled_surface);
}

Scene run(Scene scene, const VolumeOptions& o, Context& context, VolumeReport& report) {
    warn_of_bind_pose(scene, context);
    VolumeSettings settings;
    settings.axis = axis_of(o.axis, scene.up);
    report.axis = std::string(1, "xyz"[settings.axis]);
    report.unit = scene.unit;
    if (o.level) report.level = settings.level = context.resolve(*o.level, scene, "level");
    std::optional<Footprint> footprint;
    if (o.footprint) footprint.emplace(resolve_footprint(*o.footprint, scene.unit, context));
    settings.footprint = footprint ? &*footprint : nullptr;
    report.has_footprint = footprint.has_value();
    const Surface surface = selected_surface(scene, context);
    Surface other;
    if (o.with) {
        other = surface_of(read_beside(*o.with, scene, context), filled_surface);
        settings.other = &other;
    }
    report.result = volume_between(surface, settings);
    check_covers(report, o);
    refuse_disjoint(report, footprint, scene, settings.axis, context);
    warn_of_missing(report, context);
    return scene;
}

struct VolumeStage : StageOf<run> {
    StageFiles files() const override {
        StageFiles files;
        if (o.with) files.inputs.push_back(*o.with);
        if (o.footprint && !o.footprint->path.empty()) files.inputs.push_back(PathText{o.footprint->path});
        return files;
    }
    void verify(const Value& given, Problems& problems) const override {
        verify_reference(o, given, problems);
        const Value* footprint = given.is_map() ? given.find("footprint") : nullptr;
        if (footprint && o.footprint) verify_footprint(*o.footprint, *footprint, "volume", problems);
    }
};

const RegisterStage registered =
    make_stage<VolumeStage>({.name = "volume",
                             .also_called = "cut_fill cut_and_fill cutfill earthwork earthworks stockpile",
                             .about = help::volume::about,
                             .details = help::volume::details,
                             .examples = {"volume: 425", "volume: {level: 425m, footprint: parcel.geojson}",
                                          "volume: {with: design.ply, footprint: parcel.geojson}"},
                             .tells = true,
                             .keeps_scene = true,
                             .leaves_points = true},
                            declare, declare_volume_report);

} // namespace

} // namespace facetmill::volume_stage

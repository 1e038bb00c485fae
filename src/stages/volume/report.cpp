#include "stages/volume/report.hpp"

#include "base/text/readable_numbers.hpp"

#include <fmt/format.h>

namespace facetmill::volume_stage {

namespace {

constexpr const char* no_solid = "the scene is not a closed solid";

const char* name_of(Cover cover) {
    return cover == Cover::solid ? "solid" : cover == Cover::overhangs ? "overhanging" : "terrain";
}

/// A side with the areas that only a terrain has.
struct ReportedSide {
    double volume = 0, deepest = 0;
    std::optional<double> area, mean;
};

ReportedSide reported(const VolumeSide& side, bool solid) {
    ReportedSide r{side.volume, side.deepest, {}, {}};
    if (!solid) {
        r.area = side.area;
        r.mean = side.mean();
    }
    return r;
}

void declare_side(DeclareFields<ReportedSide>& d) {
    d.field("volume", &ReportedSide::volume, "The volume.").unit("cubic scene units");
    d.field("area", &ReportedSide::area, "The projected area.")
        .unit("square scene units")
        .only_when(no_solid);
    d.field("mean", &ReportedSide::mean, "The mean depth: the volume divided by the area.")
        .unit("scene units")
        .only_when(no_solid);
    d.field("deepest", &ReportedSide::deepest, "The largest depth.").unit("scene units");
}

/// A value that only surfaces have, not solids.
template <class Get>
auto of_terrain(Get get) {
    return [get](const VolumeReport& r) {
        return r.is_solid() ? std::nullopt : std::optional<double>(get(r.result));
    };
}

std::string with_unit(double value, Unit unit, const char* power) {
    const std::string in = unit == Unit::unknown ? "" : std::string(" ") + to_string(unit) + power;
    return readable(value) + in;
}

std::string line_of(const char* name, const VolumeSide& side, const VolumeReport& r) {
    std::string line = fmt::format("{} {}", name, with_unit(side.volume, r.unit, "3"));
    if (!r.is_solid() && side.area > 0)
        line += fmt::format(" on {}, mean {}, at most {}", with_unit(side.area, r.unit, "2"),
                            with_unit(side.mean(), r.unit, ""), with_unit(side.deepest, r.unit, ""));
    return line;
}

std::vector<std::string> lines_of(const VolumeReport& r) {
    if (r.is_solid())
        return {line_of("above", r.result.above, r) + ", " + line_of("below", r.result.below, r)};
    return {line_of("above (cut):", r.result.above, r), line_of("below (fill):", r.result.below, r),
            fmt::format("net {}, compared on {}",
                        with_unit(r.result.above.volume - r.result.below.volume, r.unit, "3"),
                        with_unit(r.result.compared, r.unit, "2"))};
}

void declare_areas(DeclareFields<VolumeReport>& d) {
    const auto area = [&](const char* name, auto get, const char* help) {
        d.field(name, of_terrain(get), help).unit("square scene units").only_when(no_solid);
    };
    area(
        "compared_area", [](const VolumeResult& r) { return r.compared; },
        "The projected area that was compared.");
    area(
        "equal_area", [](const VolumeResult& r) { return r.level; },
        "The projected area where both have the same height.");
    area(
        "footprint_area", [](const VolumeResult& r) { return r.footprint; },
        "The area inside the footprint. Without a footprint, the area that the scene covers.");
    area(
        "missing_area", [](const VolumeResult& r) { return r.missing; },
        "The area of the footprint that the scene does not cover.");
    d.field(
         "missing_in_other",
         [](const VolumeReport& r) {
             return r.level ? std::nullopt : std::optional(r.result.missing_in_other);
         },
         "The area of the footprint that the other surface does not cover.")
        .unit("square scene units")
        .only_when("with is given");
    area(
        "doubled_area", [](const VolumeResult& r) { return r.doubled_area + r.other_doubled_area; },
        "The area of slivers that a surface covers twice. They count twice.");
}

} // namespace

void declare_volume_report(DeclareFields<VolumeReport>& d) {
    d.field("axis", &VolumeReport::axis, "The viewing axis: x, y or z.");
    d.field(
        "surface", [](const VolumeReport& r) { return std::string(name_of(r.result.cover)); },
        "The shape of the scene: terrain, overhanging or solid.");
    d.field("level", &VolumeReport::level, "The level.").unit("scene units").only_when("level is given");
    d.object(
        "above", [](const VolumeReport& r) { return reported(r.result.above, r.is_solid()); },
        "Where the scene is higher. For a solid, its part above the level.", declare_side);
    d.object(
        "below", [](const VolumeReport& r) { return reported(r.result.below, r.is_solid()); },
        "Where the scene is lower. For a solid, its part below the level.", declare_side);
    d.field("net", of_terrain([](const VolumeResult& r) { return r.above.volume - r.below.volume; }),
            "The volume above minus the volume below.")
        .unit("cubic scene units")
        .only_when(no_solid);
    declare_areas(d);
    d.tell(lines_of);
}

void warn_of_missing(const VolumeReport& report, Context& context) {
    constexpr double least = 1e-6; // of the footprint: less does not show in six digits
    const VolumeResult& r = report.result;
    const auto warn = [&](double area, const char* where) {
        if (!(area > least * r.footprint)) return;
        context.warn("W-VOLUME-MISSING",
                     fmt::format("volume: {} of the {} ({}) has no surface in {} and is not compared",
                                 with_unit(area, report.unit, "2"),
                                 report.has_footprint ? "footprint" : "scene",
                                 percentage(100 * area / r.footprint), where),
                     "use a smaller footprint, or close the holes with clean: {holes: minimal}");
    };
    warn(r.missing, "the scene");
    warn(r.missing_in_other, "the other file");
}

} // namespace facetmill::volume_stage

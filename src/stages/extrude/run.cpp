#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/thicken/extrude.hpp"
#include "mesh/transform.hpp"
#include "mesh/unit_text.hpp"
#include "options/mark_at.hpp"
#include "stage/bind_pose.hpp"
#include "stage/options/footprint.hpp"
#include "stage/stage.hpp"
#include "stages/extrude/help.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::extrude_stage {

namespace {

struct ExtrudeOptions {
    std::optional<Length> to, by;
    ViewAxis axis = ViewAxis::up;
};

void declare(Declare<ExtrudeOptions>& d) {
    d.option("to", &ExtrudeOptions::to, "The level at which the solid ends, along the axis.")
        .also_called("level height elevation z datum")
        .primary();
    d.option("by", &ExtrudeOptions::by,
             "The height of the solid, instead of a level. A negative length goes down.")
        .also_called("length distance depth thickness amount");
    d.choice<ViewAxis>("axis", &ExtrudeOptions::axis,
                       {{"up", ViewAxis::up, "the scene's up axis, or z if it is unknown"},
                        {"x", ViewAxis::x, "along x"},
                        {"y", ViewAxis::y, "along y"},
                        {"z", ViewAxis::z, "along z"}},
                       "The axis to extrude along.");
}

struct ExtrudedPart {
    std::string part;
    std::size_t wall_faces = 0;
    double low = 0, high = 0;
};
struct ExtrudeReport {
    std::vector<ExtrudedPart> parts;
    Unit unit = Unit::unknown;
};

void declare_part(DeclareFields<ExtrudedPart>& d) {
    d.field("part", &ExtrudedPart::part, "The name of the part.");
    d.field("wall_faces", &ExtrudedPart::wall_faces, "Faces of the walls along boundary edges.");
    d.field("low", &ExtrudedPart::low, "The lowest point of the solid along the axis.").unit("scene units");
    d.field("high", &ExtrudedPart::high, "The highest point of the solid along the axis.")
        .unit("scene units");
}

void declare_report(DeclareFields<ExtrudeReport>& d) {
    d.list("parts", &ExtrudeReport::parts, "Every extruded part.", declare_part);
    d.tell([](const ExtrudeReport& r) {
        std::vector<std::string> lines;
        lines.reserve(r.parts.size());
        for (const ExtrudedPart& p : r.parts)
            lines.push_back(fmt::format("{}: from {} to {} {}, {}", p.part, readable_coordinate(p.low),
                                        readable_coordinate(p.high), unit_text(r.unit),
                                        counted(p.wall_faces, "wall face")));
        return lines;
    });
}

void verify_extent(const ExtrudeOptions& o, const Value& given, Problems& problems) {
    if (o.to.has_value() == o.by.has_value())
        problems.add(o.to ? mark_at(given, "by") : given.mark, "E-EXTRUDE",
                     o.to ? "extrude: 'to' and 'by' are both given" : "extrude: the end is missing",
                     o.to ? "remove one of them"
                          : "give a level (extrude: 400), or a length (extrude: {by: -5})");
    if (o.to && o.to->kind == Length::Kind::percent)
        problems.add(mark_at(given, "to"), "E-EXTRUDE", "extrude: a level cannot be a percentage",
                     "give a height in scene units, or with a unit");
}

[[noreturn]] void refuse(const Part& part, std::string what, std::string hint) {
    throw Error(ErrorKind::stage, "E-EXTRUDE", fmt::format("extrude: part '{}' {}", part.name, what),
                std::move(hint));
}

void check(const Part& part, const ExtrudeResult& r, const ExtrudeSettings& s) {
    switch (r.refused) {
    case NoSolid::none:
        return;
    case NoSolid::overhangs:
        refuse(part,
               fmt::format("lies above itself at {}, so it cannot be extruded straight",
                           r.at ? readable(*r.at) : "several places"),
               "cut off what overhangs with clip or crop, or use thicken, which moves along the normals");
    case NoSolid::closed:
        refuse(part, "is closed already", "use clip: {cap: true} to cut it at a level");
    case NoSolid::mixed:
        refuse(part, "has faces that look up and faces that look down", "use orient first");
    case NoSolid::edge_on:
        refuse(part, "is edge-on when seen along the axis", "give another axis: extrude: {axis: x}");
    case NoSolid::level_crosses:
        refuse(part,
               fmt::format("reaches from {} to {}, so the level {} does not lie below or above it",
                           readable_coordinate(r.low), readable_coordinate(r.high),
                           readable_coordinate(*s.level)),
               fmt::format("give a level below {} or above {}", readable_coordinate(r.low),
                           readable_coordinate(r.high)));
    }
}

Scene run(Scene scene, const ExtrudeOptions& o, Context& context, ExtrudeReport& report) {
    warn_of_bind_pose(scene, context);
    report.unit = scene.unit;
    ExtrudeSettings settings;
    settings.axis = axis_of(o.axis, scene.up);
    context.for_each_part(scene, [&](Part& part) {
        if (part.mesh.face_count() == 0) return;
        if (!inverse(part.transform))
            refuse(part, "is flattened by its node", "use transform: {bake: true} first");
        if (o.to) settings.level = context.resolve(*o.to, scene, "to", &part);
        if (o.by) settings.length = context.resolve(*o.by, scene, "by", &part);
        if (o.by && settings.length == 0)
            throw Error(ErrorKind::stage, "E-EXTRUDE", "extrude: the length is 0 in this scene",
                        "give a length in scene units");
        settings.to_world = part.transform;
        ExtrudeResult r = extrude(part.mesh, settings);
        check(part, r, settings);
        const double end =
            settings.level.value_or(settings.length < 0 ? r.low + settings.length : r.high + settings.length);
        report.parts.push_back({part.name, r.wall_faces, std::min(r.low, end), std::max(r.high, end)});
        part.mesh = std::move(r.mesh);
        context.attribute_changes(part, r.changes);
    });
    return scene;
}

struct ExtrudeStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override { verify_extent(o, given, problems); }
};

const RegisterStage registered =
    make_stage<ExtrudeStage>({.name = "extrude",
                              .about = help::extrude::about,
                              .details = help::extrude::details,
                              .examples = {"extrude: 400", "extrude: {by: -5m}", "extrude: {to: 0, axis: y}"},
                              .leaves_points = true,
                              .may_lose = MayLose::area,
                              .crossing_faces = CrossingFacePolicy::fill},
                             declare, declare_report);

} // namespace

} // namespace facetmill::extrude_stage

#include "mesh/transform.hpp"
#include "stages/thicken/help.hpp"
#include "stages/thicken/report.hpp"

#include <fmt/format.h>
#include <utility>

namespace facetmill::thicken_stage {

namespace {

using Mode = ThickenOptions::Mode;

ThickenedPart thicken_surface(Part& part, const ThickenOptions& o, double thickness, Context& context) {
    ThickenResult r =
        thicken(part.mesh, {thickness, o.side, o.miter_limit, o.self_intersections, part.transform});
    part.mesh = std::move(r.mesh);
    context.attribute_changes(part, r.changes);
    const bool has_faces = part.mesh.face_count() > 0;
    if (has_faces) warn_of_walls(part, r, thickness, o.self_intersections, context);
    return ThickenedSurface{part.name, std::move(r), has_faces, o.self_intersections};
}

ThickenedPart thicken_edges(Part& part, const ThickenOptions& o, double thickness, Context& context) {
    WiresResult r = wires(
        part.mesh, {thickness, static_cast<int>(o.sides), o.mode == Mode::boundary_edges, part.transform});
    AttributeChanges changes;
    for (const auto& a : part.mesh.attributes)
        changes.push_back({a.name, a.domain, AttributeChange::Kind::dropped, "cylinders have no attributes"});
    context.attribute_changes(part, changes);
    part.mesh = std::move(r.mesh);
    if (std::exchange(part.skinned, false)) {
        context.warn(
            "W-SKIN",
            fmt::format("thicken: the cylinders of part '{}' are in bind pose, without its skin", part.name));
    }
    return ThickenedEdges{part.name, r.edges, r.skipped};
}

Scene run(Scene scene, const ThickenOptions& o, Context& context, ThickenReport& report) {
    context.for_each_part(scene, [&](Part& part) {
        const double thickness = context.resolve(o.thickness, scene, "thickness", &part);
        if (!inverse(part.transform))
            throw Error(ErrorKind::stage, "E-THICKEN",
                        fmt::format("thicken: part '{}' is flattened by its node", part.name),
                        "transform: {bake: true} makes it a flat mesh");
        if (!(thickness > 0))
            throw Error(ErrorKind::stage, "E-THICKEN", "thicken: the thickness is 0 in this scene",
                        "give a length in scene units");
        report.parts.push_back(o.mode == Mode::surface ? thicken_surface(part, o, thickness, context)
                                                       : thicken_edges(part, o, thickness, context));
    });
    return scene;
}

/// Of wires, only the edges count.
CrossingFacePolicy crossing_faces(const ThickenOptions& o) {
    return o.mode == Mode::surface ? CrossingFacePolicy::fill : CrossingFacePolicy::keep;
}

const RegisterStage registered = make_stage<ThickenOptions>(
    {.name = "thicken",
     .about = help::thicken::about,
     .details = help::thicken::details,
     .examples = {"thicken: 2mm", "thicken: {thickness: 1%, side: centred}",
                  "thicken: {thickness: 0.5%, mode: edges, sides: 6}"},
     .may_lose = MayLose::area,
     .crossing_faces = CrossingFacePolicy::fill},
    declare_thicken, declare_thicken_report, run, {.crossing_faces = crossing_faces});

} // namespace

} // namespace facetmill::thicken_stage

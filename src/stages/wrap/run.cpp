#include "geometry/wrap/wrap.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "mesh/transform.hpp"
#include "stage/stage.hpp"
#include "stages/wrap/help.hpp"

#include <fmt/format.h>

namespace facetmill::wrap_stage {

namespace {

struct WrapOptions {
    enum class Attributes { none, nearest };

    Length alpha = Length::percent(2);
    std::optional<Length> offset;
    Attributes attributes = Attributes::none;
    std::int64_t max_faces = 5000000;
};

void declare(Declare<WrapOptions>& d) {
    d.option("alpha", &WrapOptions::alpha, "The narrowest gap that the wrap enters.")
        .also_called("gap voxel_size resolution")
        .above(0)
        .primary();
    d.option("offset", &WrapOptions::offset,
             "The distance of the wrap from the input. Default: a thirtieth of alpha.")
        .also_called("distance thickness")
        .above(0);
    d.choice<WrapOptions::Attributes>(
        "attributes", &WrapOptions::attributes,
        {{"none", WrapOptions::Attributes::none, "the wrap has no attributes and no materials"},
         {"nearest", WrapOptions::Attributes::nearest, "from the nearest point of the input"}},
        "The attributes of the wrap.");
    d.option("max_faces", &WrapOptions::max_faces, "The largest number of faces of a part.").between(4, 5e8);
}

struct WrappedPart {
    std::string part;
    std::size_t faces = 0, components = 0;
    double alpha = 0, offset = 0;
};

struct WrapReport {
    std::vector<WrappedPart> parts;
};

void declare_part(DeclareFields<WrappedPart>& d) {
    d.field("part", &WrappedPart::part, "The name of the part.");
    d.field("faces", &WrappedPart::faces, "The number of faces of the wrap.");
    d.field("components", &WrappedPart::components, "The number of components of the wrap.");
    d.field("alpha", &WrappedPart::alpha, "The narrowest gap that the wrap enters.").unit("scene units");
    d.field("offset", &WrappedPart::offset, "The distance of the wrap from the input.").unit("scene units");
}

void declare_report(DeclareFields<WrapReport>& d) {
    d.list("parts", &WrapReport::parts, "Each wrapped part.", declare_part);
    d.tell([](const WrapReport& report) {
        std::vector<std::string> lines;
        for (const auto& p : report.parts)
            lines.push_back(fmt::format("{}: {} faces, {}, alpha {:.6g}, offset {:.6g}", p.part,
                                        grouped(p.faces), counted(p.components, "component"), p.alpha,
                                        p.offset));
        return lines;
    });
}

Scene run(Scene scene, const WrapOptions& o, Context& context, WrapReport& report) {
    context.for_each_part(scene, [&](Part& part) {
        const double alpha = context.resolve(o.alpha, scene, "alpha", &part);
        const double offset = o.offset ? context.resolve(*o.offset, scene, "offset", &part) : alpha / 30;
        if (!is_similarity(part.transform))
            throw Error(
                ErrorKind::stage, "E-WRAP",
                fmt::format("wrap: the node of part '{}' scales directions differently, so it would distort "
                            "distances",
                            part.name),
                "use transform: {bake: true} first");
        const bool nearest = o.attributes == WrapOptions::Attributes::nearest;
        const double stretch = mean_stretch(part.transform);
        WrapResult r = wrap(
            part.mesh, {alpha / stretch, offset / stretch, static_cast<std::size_t>(o.max_faces), nearest});
        part.mesh = std::move(r.mesh);
        context.attribute_changes(part, r.changes);
        if (part.skinned && !nearest) {
            part.skinned = false;
            context.warn(
                "W-SKIN",
                fmt::format("wrap: the wrap of part '{}' is in bind pose, without its skin", part.name),
                "use attributes: nearest to keep it");
        }
        report.parts.push_back({part.name, part.mesh.face_count(), r.components, alpha, offset});
    });
    return scene;
}

const RegisterStage registered = make_stage<StageOf<run>>(
    {.name = "wrap",
     .also_called = "alpha_wrap shrinkwrap watertight voxel_remesh",
     .about = help::wrap::about,
     .details = help::wrap::details,
     .examples = {"wrap", "wrap: {alpha: 1%, offset: 0.1%}", "wrap: {alpha: 5mm, attributes: nearest}"},
     .lines = LinesPolicy::work,
     .may_lose = MayLose::all},
    declare, declare_report);

} // namespace

} // namespace facetmill::wrap_stage

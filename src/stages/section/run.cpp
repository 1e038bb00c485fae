#include "options/mark_at.hpp"
#include "stage/options/plane.hpp"
#include "stage/stage.hpp"
#include "stages/section/drawing.hpp"
#include "stages/section/hatch.hpp"
#include "stages/section/help.hpp"
#include "stages/section/report.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

struct SectionOptions {
    std::optional<PlaneOption> plane;
    std::optional<Length> spacing;
    std::optional<std::int64_t> count;
    std::optional<HatchOption> hatch;
    std::vector<PathText> path;
};

void declare(Declare<SectionOptions>& d) {
    d.group("plane", &SectionOptions::plane, "The plane, or the first of a stack; z=50% unless given.",
            declare_plane)
        .primary();
    d.option("spacing", &SectionOptions::spacing,
             "The distance between the planes of a stack, along the normal.")
        .above(0);
    d.option("count", &SectionOptions::count,
             "The number of planes: with spacing, starting at the plane; without it, in the middle of this "
             "many equal slices of the extent.")
        .between(1, most_planes);
    d.group("hatch", &SectionOptions::hatch, "Parallel lines, clipped to the sections.", declare_hatch);
    d.option("path", &SectionOptions::path,
             "The drawing to write, to scale, or a list of drawings; the suffix decides the format: .svg, "
             ".dxf or .json.");
}

void verify(const SectionOptions& o, const Value& given, Problems& problems) {
    if (o.plane) verify_plane(*o.plane, given.mark, problems);
    for (const auto& path : o.path)
        if (!io::is_drawing(path.text))
            problems.add(mark_at(given, "path"), "E-DRAWING",
                         fmt::format("section: drawings are not written as '{}'", path.text),
                         "the formats are .svg, .dxf and .json");
}

Scene run(Scene scene, const SectionOptions& o, Context& context, SectionReport& report) {
    PlaneOption middle;
    middle.normal = Vec3{0, 0, 1};
    middle.through.kind = PlanePlace::Kind::centre;
    const Plane plane = resolve_plane(o.plane.value_or(middle), scene, context, "plane");
    const Stack stack = stack_for(scene, plane, o.spacing, o.count, context);
    std::optional<polygon::HatchSettings> hatching;
    if (o.hatch) hatching = resolve_hatch(*o.hatch, scene, context);
    const auto drawing =
        std::make_shared<const io::Drawing>(draw_sections(scene, plane, stack, hatching, context));
    report = report_of(drawing, scene, stack.spacing, context);
    for (const auto& path : o.path) {
        const std::string text = io::drawing_for(path.text, *drawing);
        context.output(path.text, std::as_bytes(std::span(text)));
    }
    return scene;
}

const RegisterStage registered{make_stage<SectionOptions>(
    {.name = "section",
     .about = help::section::about,
     .details = help::section::details,
     .examples = {"section: z=50%",
                  "section: {plane: {normal: [1, 0, 1], through: centre}, path: cut.svg, hatch: 2%}",
                  "section: {plane: z=0, spacing: 2mm, path: [layers.svg, layers.dxf, layers.json]}",
                  "section: {count: 20}"}},
    declare, declare_section_report, run,
    StageHooks<SectionOptions>{.files =
                                   [](const SectionOptions& o) {
                                       return StageFiles{{}, o.path};
                                   },
                               .verify = verify})};

} // namespace

} // namespace facetmill

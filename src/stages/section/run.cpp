#include "options/mark_at.hpp"
#include "stages/section/hatch.hpp"
#include "stage/options/plane.hpp"
#include "stages/section/drawing.hpp"
#include "stages/section/report.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

struct SectionOptions {
    std::optional<PlaneOption> plane;
    std::optional<Length> every;
    std::optional<std::int64_t> count;
    std::optional<HatchOption> hatch;
    std::vector<PathText> to;
};

void declare(Declare<SectionOptions>& d) {
    d.group("plane", &SectionOptions::plane, "The plane, or the first of a stack; z=50% when not given.",
            declare_plane)
        .primary();
    d.option("every", &SectionOptions::every, "Distance between the planes of a stack, along the normal.")
        .above(0);
    d.option("count", &SectionOptions::count,
             "How many planes: from the plane on with every; without it in the middles of as many equal "
             "slices of the "
             "extent.")
        .between(1, most_planes);
    d.group("hatch", &SectionOptions::hatch, "Parallel lines, clipped to the sections.", declare_hatch);
    d.option("to", &SectionOptions::to, "Drawings to write, to scale: .svg, .dxf or .json.");
}

void verify(const SectionOptions& o, const Value& given, Problems& problems) {
    if (o.plane) verify_plane(*o.plane, given.mark, problems);
    for (const auto& path : o.to)
        if (!io::is_drawing(path.text))
            problems.add(mark_at(given, "to"), "E-DRAWING",
                         fmt::format("section: drawings are not written as '{}'", path.text),
                         "the formats are .svg, .dxf and .json");
}

Scene run(Scene scene, const SectionOptions& o, Context& context) {
    PlaneOption middle;
    middle.normal = Vec3{0, 0, 1};
    middle.through.kind = PlanePlace::Kind::centre;
    const Plane plane = resolve_plane(o.plane.value_or(middle), scene, context, "plane");
    const Stack stack = stack_for(scene, plane, o.every, o.count, context);
    std::optional<polygon::HatchSettings> hatching;
    if (o.hatch) hatching = resolve_hatch(*o.hatch, scene, context);
    const io::Drawing drawing = draw_sections(scene, plane, stack, hatching, context);
    report_sections(drawing, scene, stack.spacing, context);
    for (const auto& path : o.to) {
        const std::string text = io::drawing_for(path.text, drawing);
        context.output(path.text, std::as_bytes(std::span(text)));
    }
    return scene;
}

const RegisterStage registered{make_stage<SectionOptions>(
    {.name = "section",
     .about = "Cuts plane sections: contours with areas, centroids and moments, and drawings to scale.",
     .details =
         "A plane, or a stack of parallel ones, gives polygons with their holes, in the frame that the "
         "report states: its origin is the foot of the world's origin on the plane, u is the axis after the "
         "normal's longest component, v is normal x u. Each contour has its orientation, kind (triangle, "
         "quad, convex, concave, complex, self-intersecting), area, centroid, second moments about the "
         "origin and the centroid, and principal axes, all in the plane and in the world, and so has the "
         "section as a whole, its holes taken off (moments there are the integrals of products of "
         "coordinates). Over a stack, areas times distance are compared with the volume. A plane that misses "
         "the mesh gives an empty section, which is a result.\n\n"
         "Vertices are classified once, by exact signs; one on the plane counts as above it, so a section is "
         "that just below the plane: of a cube on the floor z = 0 gives nothing and the top gives a "
         "square.\n\n"
         "Drawings are SVG (sections side by side), DXF (one layer a section) and JSON (all points and "
         "measures). The scene passes on unchanged. Sources: the notes on polygon types, ordering, area, "
         "centroid and moments of polygons, and on clipping a line to a complex polygon (hatch).",
     .examples = {"section: z=50%",
                  "section: {plane: {normal: [1, 0, 1], through: centre}, to: cut.svg, hatch: 2%}",
                  "section: {plane: z=0, every: 2mm, to: [layers.svg, layers.dxf, layers.json]}",
                  "section: {count: 20}"}},
    declare, run,
    StageHooks<SectionOptions>{.files =
                                   [](const SectionOptions& o) {
                                       return StageFiles{{}, o.to};
                                   },
                               .verify = verify})};

} // namespace

} // namespace facetmill

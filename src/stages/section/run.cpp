#include "base/progress.hpp"
#include "stages/section/help.hpp"
#include "stages/section/options.hpp"
#include "stages/section/report.hpp"

#include <fmt/format.h>

namespace facetmill::section_stage {

namespace {

constexpr double max_lines = 5e6;

/// Refuses to draw more lines than anybody can look at, or memory can hold.
void check_hatching(const std::vector<Section>& sections, double spacing) {
    double lines = 0;
    for (const Section& s : sections) {
        Box box;
        for (const Vec2& p : s.points) box.add(Vec3{p.x, p.y, 0});
        if (!box.empty()) lines += box.diagonal() / spacing;
    }
    if (!(lines <= max_lines))
        throw Error(ErrorKind::limit, "E-HATCH",
                    fmt::format("hatching all sections would take about {:.0f} lines, and at most {:.0f} "
                                "are drawn",
                                lines, max_lines),
                    "choose a larger spacing, or fewer planes");
}

/// The planes: one alone without spacing and count, else as geometry/section_stack says over the extent of
/// the parts selected. Throws stage (E-SECTION) for a spacing that comes to 0, and what stack_of throws.
Stack stack_for(const Scene& scene, const Plane& plane, const std::optional<Length>& given,
                const std::optional<std::int64_t>& count, Context& context) {
    if (!given && !count) return {};
    std::optional<double> spacing;
    if (given) spacing = context.resolve(*given, scene, "spacing");
    if (spacing && !(*spacing > 0))
        throw Error(ErrorKind::stage, "E-SECTION", "'spacing' must be above zero, and it is 0 in this scene",
                    "give a length in scene units, or count");
    Extent extent;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) extent.add(extent_along(plane, part.mesh, part.transform));
    return stack_of(extent, spacing, count);
}

/// A sheet for each plane, with the sections of the parts selected and their hatching. Throws what section
/// and hatch throw, and limit (E-HATCH) for a stack that would take more than five
/// million lines in a part.
io::Drawing draw_sections(const Scene& scene, const Plane& plane, const Stack& stack,
                          const std::optional<polygon::HatchSettings>& hatching, Context& context) {
    io::Drawing drawing{context.name(), scene.unit, {}};
    const SectionFrame frame = frame_of(plane);
    for (const double h : stack.heights) {
        drawing.sheets.push_back({h, frame, {}});
        drawing.sheets.back().frame.origin += frame.normal * h;
    }
    for (const Part& part : scene.parts) {
        if (!context.selects(part, scene)) continue;
        auto sections = section(part.mesh, {plane, stack.heights, part.transform, part.cuts.get()});
        if (hatching && sections.size() > 1) check_hatching(sections, hatching->spacing);
        for (std::size_t k = 0; k < sections.size(); ++k) {
            std::vector<polygon::Segment> lines;
            if (hatching) lines = polygon::hatch(sections[k].filled(), *hatching);
            drawing.sheets[k].parts.push_back({part.name, std::move(sections[k]), std::move(lines)});
        }
    }
    return drawing;
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
        const Share silent(nullptr);
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
                  "section: {count: 20}"},
     .tells = true},
    declare_section, declare_section_report, run,
    StageHooks<SectionOptions>{.files =
                                   [](const SectionOptions& o) {
                                       return StageFiles{{}, o.path};
                                   },
                               .verify = verify_section})};

} // namespace

} // namespace facetmill::section_stage

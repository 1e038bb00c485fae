#include "base/progress.hpp"
#include "cells/process/inspect_cells.hpp"
#include "cells/process/section_cells.hpp"
#include "geometry/inspect/inspect.hpp"
#include "stage/bind_pose.hpp"
#include "stage/world_outline.hpp"
#include "stages/section/help.hpp"
#include "stages/section/options.hpp"
#include "stages/section/report.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::section_stage {

namespace {

constexpr double max_lines = 5e6;

/// Refuses to draw more lines than a viewer can show or memory can hold.
void check_hatching(const std::vector<Section>& sections, double spacing) {
    double lines = 0;
    for (const Section& s : sections) {
        Box box;
        for (const Vec2& p : s.points) box.add(Vec3{p.x, p.y, 0});
        if (!box.empty()) lines += box.diagonal() / spacing;
    }
    if (!(lines <= max_lines))
        throw Error(
            ErrorKind::limit, "E-HATCH",
            fmt::format("hatching all sections would take about {:.0f} lines, but the limit is {:.0f}", lines,
                        max_lines),
            "choose a larger spacing, or fewer planes");
}

/// The extent of the selected parts along the normal.
Extent extent_of(const Scene& scene, const Plane& plane, const Context& context) {
    Extent extent;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) extent.add(extent_along(plane, part.mesh, part.transform));
    return extent;
}

/// The planes: a single plane without spacing and count, otherwise a stack over the extent
/// (geometry/section_stack). Throws a stage error (E-SECTION) if the spacing is 0, and the errors of
/// stack_of.
template <class ExtentOf>
Stack stack_for(const SectionOptions& o, const Scene& scene, ExtentOf&& extent, Context& context) {
    if (!o.spacing && !o.count) return {};
    std::optional<double> spacing;
    if (o.spacing) spacing = context.resolve(*o.spacing, scene, "spacing");
    if (spacing && !(*spacing > 0))
        throw Error(ErrorKind::stage, "E-SECTION", "'spacing' is 0 in this scene, but it must be above zero",
                    "give a length in scene units, or count");
    return stack_of(extent(), spacing, o.count);
}

Vec3 up_of(const Scene& scene) { return scene.up == UpAxis::y ? Vec3{0, 1, 0} : Vec3{0, 0, 1}; }

/// The default is in the middle. Contours start at 0 instead, so that their heights are multiples of the
/// spacing. Throws a stage error (E-SECTION) for a profile whose plane is not vertical.
Plane plane_for(const SectionOptions& o, const Scene& scene, Context& context) {
    using Kind = io::DrawingLayout::Kind;
    if (!o.plane && o.layout == Kind::contours && o.spacing && !o.count) return {up_of(scene), {}, 0};
    PlaneOption middle;
    middle.normal = o.layout == Kind::contours ? up_of(scene) : Vec3{0, 0, 1};
    middle.through.kind = PlanePlace::Kind::centre;
    const Plane plane = resolve_plane(o.plane.value_or(middle), scene, context, "plane");
    if (o.layout == Kind::profile && dot(plane.normal, up_of(scene)) != 0)
        throw Error(ErrorKind::stage, "E-SECTION", "the plane of a profile is not vertical",
                    scene.up == UpAxis::y
                        ? "give, for example, plane: x=50%, or a normal without a y component"
                        : "give, for example, plane: x=50%, or a normal without a z component");
    return plane;
}

std::optional<polygon::HatchSettings> hatching_for(const SectionOptions& o, const Scene& scene,
                                                   Context& context) {
    return o.hatch ? std::optional(resolve_hatch(*o.hatch, scene, context)) : std::nullopt;
}

/// The volume of the selected parts in the world; none if a part is not closed.
std::optional<double> volume_of(const Scene& scene, const Context& context) {
    double volume = 0;
    for (const Part& part : scene.parts) {
        if (!context.selects(part, scene)) continue;
        const auto own = inspect(part.mesh).volume;
        if (!own) return {};
        volume += *own * std::abs(part.transform.determinant());
    }
    return volume;
}

struct StackedPlanes {
    Plane plane;
    Stack stack;
};

io::DrawingLayout layout_of(const SectionOptions& o) { return {o.layout, o.scale, o.exaggeration}; }

/// One sheet per plane, with the sections of the selected parts and their hatching. Throws the errors of
/// section and hatch. Throws a limit error (E-HATCH) if the hatching of a part would need more than five
/// million lines.
io::Drawing draw_sections(const Scene& scene, const StackedPlanes& planes, const io::DrawingLayout& layout,
                          const std::optional<polygon::HatchSettings>& hatching, Context& context) {
    const auto& [plane, stack] = planes;
    io::Drawing drawing{context.name(), scene.unit, {}, scene.up, layout};
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

void write_drawings(const SectionOptions& o, const io::Drawing& drawing, Context& context) {
    for (const auto& path : o.path) {
        const std::string text = io::drawing_for(path.text, drawing);
        const ProgressScope silent(nullptr);
        context.output(path.text, std::as_bytes(std::span(text)));
    }
}

Scene run(Scene scene, const SectionOptions& o, Context& context, SectionReport& report) {
    warn_of_bind_pose(scene, context);
    const Plane plane = plane_for(o, scene, context);
    const auto extent = [&] { return extent_of(scene, plane, context); };
    const Stack stack = stack_for(o, scene, extent, context);
    const auto hatching = hatching_for(o, scene, context);
    const auto drawing = std::make_shared<const io::Drawing>(
        draw_sections(scene, {plane, stack}, layout_of(o), hatching, context));
    std::optional<double> volume;
    const double spacing = layout_of(o).is_of_lines() ? 0 : stack.spacing;
    if (spacing > 0) volume = volume_of(scene, context);
    report = report_of(
        drawing, spacing, volume, [&] { return volume || volume_of(scene, context); }, context);
    write_drawings(o, *drawing, context);
    return scene;
}

struct SectionStage : StageOf<run> {
    StageFiles files() const override { return StageFiles{{}, o.path}; }
    void verify(const Value& given, Problems& problems) const override { verify_section(o, given, problems); }
    /// Loads only the faces that the planes cut, because a section needs no others.
    void on_cells(CellFlow& flow, Context& context) const override;
};

void SectionStage::on_cells(CellFlow& flow, Context& context) const {
    const Scene world = world_outline(flow);
    const Plane plane = plane_for(o, world, context);
    const auto extent = [&] { return cells::extent_of_cells(*flow.partition, plane, flow.transform); };
    const Stack stack = stack_for(o, world, extent, context);
    const auto hatching = hatching_for(o, world, context);
    Scene scene = flow.outline();
    Part& part = scene.parts.front();
    part.mesh = cells::faces_at_planes(*flow.partition, {plane, stack.heights, flow.transform}, flow.means);
    const auto drawing = std::make_shared<const io::Drawing>(
        draw_sections(scene, {plane, stack}, layout_of(o), hatching, context));
    std::optional<double> volume;
    const double spacing = layout_of(o).is_of_lines() ? 0 : stack.spacing;
    if (spacing > 0) volume = cells::inspect_cells(*flow.partition, flow.transform, flow.means).volume;
    const auto is_closed = [&] {
        return volume || cells::inspect_cells(*flow.partition, flow.transform, flow.means).volume;
    };
    const SectionReport report = report_of(drawing, spacing, volume, is_closed, context);
    context.report(*info->result, &report);
    write_drawings(o, *drawing, context);
}

const RegisterStage registered = make_stage<SectionStage>(
    {.name = "section",
     .also_called = "slice contours cross_section",
     .about = help::section::about,
     .details = help::section::details,
     .examples =
         {"section: z=50%",
          "section: {plane: {normal: [1, 0, 1], through: centre}, path: cut.svg, hatch: 2%}",
          "section: {plane: z=0, spacing: 2mm, path: [layers.svg, layers.dxf, layers.json]}",
          "section: {layout: contours, spacing: 1, scale: 1000, path: [map.svg, map.dxf, map.geojson]}",
          "section: {plane: x=50%, layout: profile, exaggeration: 5, scale: 500, path: profile.svg}",
          "section: {count: 20}"},
     .tells = true,
     .keeps_scene = true,
     .leaves_points = true},
    declare_section, declare_section_report);

} // namespace

} // namespace facetmill::section_stage

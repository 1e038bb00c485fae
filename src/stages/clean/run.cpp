#include "base/text/words.hpp"
#include "cells/process/clean_cells.hpp"
#include "cells/process/inspect_cells.hpp"
#include "geometry/normals/unit_vectors.hpp"
#include "mesh/transform.hpp"
#include "stages/clean/help.hpp"
#include "stages/clean/hidden_parts.hpp"
#include "stages/clean/options.hpp"
#include "stages/clean/report.hpp"

#include <fmt/format.h>

namespace facetmill::clean_stage {

namespace {

void warn(const Part& part, const std::vector<NotDone>& all, Context& context) {
    if (all.empty()) return;
    context.warn("W-CLEAN",
                 fmt::format("clean: {} of part '{}' not done, the first in step '{}': {}",
                             counted(all.size(), "repair"), part.name, all[0].step, all[0].why),
                 "the report lists the first repairs that failed, with their positions");
}

Scene run(Scene scene, const CleanOptions& o, Context& context, CleanReport& report) {
    UntangleBudget budget;
    const HiddenOfParts hidden(o, scene, context);
    context.for_each_part(scene, [&](Part& part) {
        const auto removed = hidden.remove(part, static_cast<std::size_t>(&part - scene.parts.data()));
        CleanSettings settings = clean_settings(o, scene, part, context);
        settings.budget = budget;
        CleanResult r = clean(std::move(part.mesh), settings);
        budget = r.budget;
        if (r.short_of_memory) context.mark_uncacheable();
        part.mesh = std::move(r.mesh);
        std::size_t scaled = 0;
        if (o.unit_vectors) r.changes = changes_in_sequence(r.changes, scale_to_unit(part.mesh, scaled));
        context.attribute_changes(part, r.changes);
        warn(part, r.not_done, context);
        const double stretch = mean_stretch(part.transform);
        r.counts.component_area *= stretch * stretch;
        report.parts.push_back(
            {part.name, r.counts, scaled, removed, first_not_done(r.not_done, part.transform)});
    });
    return scene;
}

struct CleanStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override { verify_clean(o, given, problems); }
    /// Removing components loses area on purpose. A union removes the overlap of solids.
    MayLose may_lose() const override {
        if (o.hidden) return MayLose::all;
        if (o.removes_components()) return MayLose::area;
        const bool unites = o.self_intersections == Untangle::unite || o.self_intersections == Untangle::all;
        return unites ? MayLose::half : MayLose::tenth;
    }
    /// The policy for intersecting faces also covers faces that intersect themselves.
    CrossingFacePolicy crossing_faces() const override {
        return o.self_intersections == Untangle::off ? CrossingFacePolicy::keep : CrossingFacePolicy::fill;
    }
    void on_cells(CellFlow& flow, Context& context) const override;
    std::optional<std::string> why_not_on_cells() const override {
        if (o.hidden) return "rays need the whole scene";
        if (o.unit_vectors) return "cells carry no normals and no joint weights";
        return cells::why_not_in_cells(clean_steps_of(o));
    }
};

void CleanStage::on_cells(CellFlow& flow, Context& context) const {
    const Scene outline = flow.outline();
    const Part& part = outline.parts.front();
    const std::size_t faces = flow.partition->faces();
    const cells::CleanedCells cleaned = cells::clean_cells(
        flow.partition, clean_settings(o, outline, part, context), flow.means, flow.transform);
    const CleanResult& r = cleaned.result;
    flow.box = cells::box_of_cells(*flow.partition, flow.transform);
    context.attribute_changes(part, r.changes);
    warn(part, r.not_done, context);
    const CleanReport report{{{part.name, r.counts, 0, {}, first_not_done(r.not_done, part.transform)}}};
    context.report(*info->result, &report);
    warn_of_lost_surface({{part.name, faces, cleaned.area_before}},
                         {{part.name, flow.partition->faces(), cleaned.area_after}}, may_lose(), context);
}

const RegisterStage registered = make_stage<CleanStage>(
    {.name = "clean",
     .also_called = "repair fix heal weld fill_holes close_holes fill",
     .about = help::clean::about,
     .details = help::clean::details,
     .examples = {"clean", "clean: {holes: minimal, components: {min_faces: 10}}",
                  "clean: {self_intersections: union}", "clean: {weld: near, stitch: near, tolerance: 0.01%}",
                  "clean: {holes: {method: smooth, max_edges: 50}, inner_components: true}",
                  "clean: {components: {min_size: 2mm}, hidden: true}"},
     .lines = LinesPolicy::pass,
     .crossing_faces = CrossingFacePolicy::fill},
    declare_clean, declare_clean_report);

} // namespace

} // namespace facetmill::clean_stage

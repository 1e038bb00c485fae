#include "stages/simplify/cells.hpp"

#include "base/text/words.hpp"
#include "cells/hierarchy/hierarchy.hpp"
#include "mesh/power_scale.hpp"
#include "mesh/transform.hpp"
#include "stages/simplify/parts.hpp"

#include <fmt/format.h>

namespace facetmill::simplify_stage {

namespace {

SimplifySettings settings_in_cells(const SimplifyOptions& o, const CellFlow& flow, Context& context) {
    SimplifySettings settings = simplify_settings(o);
    if (o.lock.box) settings.lock.body = planes_of(*o.lock.box);
    if (o.max_quadric_error) {
        const Length& limit = *o.max_quadric_error;
        const bool of_part = limit.kind == Length::Kind::percent && limit.of == Length::Of::part;
        const Scene outline =
            flow.outline(); // limits use world units, but cells are stored before the transform
        settings.max_quadric_error =
            of_part ? limit.amount / 100 * diagonal(outline.parts.front().mesh.bounds())
                    : context.resolve(limit, outline, "max_quadric_error") / greatest_stretch(flow.transform);
        if (!(*settings.max_quadric_error > 0)) settings.max_quadric_error.reset(); // 0: a point
    }
    return settings;
}

/// Converts the result to the common result of simplification.
SimplifyResult told(const cells::HierarchyResult& done, const Mesh& mesh, const cells::Partition& partition) {
    SimplifyResult r;
    r.changes = done.changes;
    r.stop = done.stop;
    r.blocked = done.blocked;
    r.turned = done.turned;
    r.collapses = done.collapses;
    r.largest_error = done.error;
    r.faces_given = r.faces_before = done.faces_before;
    r.vertices_before = partition.vertices();
    r.faces_after = mesh.face_count();
    r.vertices_after = mesh.vertex_count();
    return r;
}

} // namespace

std::optional<std::string> why_not_on_cells(const SimplifyOptions& o) {
    SimplifySettings settings = o.settings;
    if (o.max_error) return "max_error needs the whole mesh in memory";
    if (o.vertices) return "on cells the target must be faces or ratio";
    if (o.lods) return "lods needs the whole mesh in memory";
    if (o.certify) return "certify needs the whole mesh in memory";
    return cells::why_not_in_cells(settings);
}

void simplify_on_cells(const SimplifyOptions& o, CellFlow& flow, Context& context) {
    const SimplifySettings settings = settings_in_cells(o, flow, context);
    if (flow.means.job) {
        cells::simplify_job(*flow.partition, settings, flow.means, flow.transform);
        return;
    }
    cells::HierarchyResult done =
        cells::simplify_cells(*flow.partition, settings, flow.means, flow.transform);
    Scene scene = flow.outline();
    Part& part = scene.parts.front();
    part.changed = true;
    part.mesh = std::move(done.mesh);
    SimplifyReport report;
    SimplifiedPart& entry = report.parts.emplace_back();
    entry.part = part.name;
    entry.result = told(done, part.mesh, *flow.partition);
    entry.max_quadric_error = settings.max_quadric_error;
    context.attribute_changes(part, entry.result.changes);
    warn_of_stop(part, entry.result, {.less = !o.ratio || o.ratio->value < 1 || o.faces}, context);
    if (entry.result.stop == SimplifyResult::Stop::max_quadric_error)
        warn_of_limit({{part.name, entry.result.faces_before, entry.result.faces_after}},
                      *o.max_quadric_error, context);
    context.report(fields_of<SimplifyReport>(declare_simplify_report), &report);
    context.say(fmt::format("{} simplified in {}; the deviation is not measured", counted(done.cells, "cell"),
                            counted(done.levels, "level")));
    flow.surface = PartSurface{part.name, done.faces_before, done.area_before};
    flow.partition.reset();
    flow.scene = std::move(scene);
}

} // namespace facetmill::simplify_stage

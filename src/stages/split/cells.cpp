#include "stages/split/cells.hpp"

#include "cells/process/split_source.hpp"
#include "stages/split/report.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::split_stage {

namespace {

/// The attribute changes of a pass. The first cell represents all cells.
AttributeChanges changes_of(const cells::Partition& partition) {
    const Mesh mesh = partition.cell(0).mesh;
    return split(mesh, {.method = SplitMethod::midpoint}).changes;
}

} // namespace

std::optional<std::string> why_not_on_cells(const SplitOptions& o) {
    for (const auto& [given, name] :
         {std::pair{o.max_edge.has_value(), "max_edge"}, std::pair{o.min_angle.has_value(), "min_angle"},
          std::pair{o.max_faces.has_value(), "max_faces"}})
        if (given) return fmt::format("the target {} needs the whole mesh; passes works", name);
    if (o.chosen() != SplitMethod::midpoint)
        return fmt::format("the method {} needs the whole mesh; midpoint works", to_string(o.chosen()));
    return {};
}

double triangles_of_one(const SplitOptions& o) {
    return why_not_on_cells(o) ? 1 : std::ldexp(1.0, 2 * split_settings(o).passes);
}

void split_on_cells(const SplitOptions& o, CellFlow& flow, Context& context) {
    const int passes = split_settings(o).passes;
    const std::uint64_t before = flow.partition->faces();
    cells::require_countable("split", static_cast<double>(before) * triangles_of_one(o), "use fewer passes");
    SplitResult result;
    result.changes = passes > 0 ? changes_of(*flow.partition) : AttributeChanges{};
    SplitPart told;
    told.part = flow.part;
    told.before = cells::shape_of_cells(*flow.partition, flow.transform);
    for (; result.passes < passes; ++result.passes) {
        result.shared += cells::shared_spots(*flow.partition, flow.means);
        auto source = cells::split_source(flow.partition->shared_source());
        flow.partition.reset(); // release temporary data first
        flow.partition = std::make_unique<cells::Partition>(std::move(source), flow.means);
    }
    told.after = cells::shape_of_cells(*flow.partition, flow.transform);
    told.passes = result.passes;
    told.stopped_by = stopped_by(o, result.stop);
    told.added_faces = flow.partition->faces() - before;
    const Scene outline = flow.outline();
    warn_of_spots(outline.parts.front(), result, SplitMethod::midpoint, context);
    context.attribute_changes(outline.parts.front(), result.changes);
    SplitReport report{told.added_faces, {told}};
    context.report(fields_of<SplitReport>(declare_split_report), &report);
}

} // namespace facetmill::split_stage

#include "stages/crumple/cells.hpp"

#include "cells/process/crumple_source.hpp"
#include "cells/process/inspect_cells.hpp"
#include "cells/process/split_source.hpp"
#include "stage/world_outline.hpp"
#include "stages/crumple/report.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::crumple_stage {

namespace {

void warn_of_dropped(const AttributeChanges& changes, const std::string& part, Context& context) {
    for (const AttributeChange& change : changes)
        if (change.kind == AttributeChange::Kind::dropped)
            context.warn(
                "W-CELLS",
                fmt::format("crumple: cells of part '{}' lose {}: {}", part, change.attribute, change.why),
                "compute normals when the mesh is in memory, or give more memory");
}

} // namespace

std::optional<std::string> why_not_on_cells(const CrumpleOptions& o) {
    if (o.grid > cells::FaceCut::most)
        return fmt::format("grid: above {}, the pieces of a face are too many for cells; use split midpoint "
                           "first to make faces smaller",
                           cells::FaceCut::most);
    if (o.direction != CrumpleSettings::Direction::free)
        return "direction: normals need all faces of a vertex, but cells contain only some; free works";
    if (o.boundary != CrumpleSettings::Boundary::free)
        return "boundary: fixed needs all faces of a vertex, but cells contain only some; free works";
    if (o.self_intersections != CrumpleOptions::Intersections::allow)
        return "self_intersections other than allow need the whole mesh";
    if (o.mask) return "mask: cells do not contain the data for it";
    return {};
}

double triangles_of_one(const CrumpleOptions& o) {
    const auto grid = static_cast<double>(o.grid);
    return why_not_on_cells(o) ? 1 : grid * grid;
}

void crumple_on_cells(const CrumpleOptions& o, CellFlow& flow, Context& context) {
    const std::uint64_t before = flow.partition->faces();
    cells::require_countable("crumple", static_cast<double>(before) * triangles_of_one(o),
                             "use a smaller grid");
    const Scene outline = world_outline(flow);
    const Part& part = outline.parts.front();
    const double amplitude = context.resolve(o.amplitude, outline, "amplitude", &part);
    CrumpleSettings settings = crumple_settings(o, outline, amplitude);
    settings.amplitude = amplitude;
    settings.to_world = flow.transform;
    const Mesh first = flow.partition->cell(0).mesh;
    const auto still = cells::split_source(flow.partition->shared_source(), {static_cast<int>(o.grid)});
    flow.partition.reset(); // release temporary data first
    flow.partition = std::make_unique<cells::Partition>(cells::crumple_source(still, settings), flow.means);
    flow.box = cells::box_of_cells(*flow.partition, flow.transform);
    const cells::CrumpledCells crumpled = cells::crumpled_cells(*flow.partition, *still, flow.transform);
    if (o.frequency == 0) warn_of_tangles(flow.part, crumpled.mean_edge, settings.amplitude, context);
    const AttributeChanges changes = changes_in_sequence(grid_split(first, static_cast<int>(o.grid)).changes,
                                                         cells::crumple_changes(first));
    warn_of_dropped(changes, flow.part, context);
    context.attribute_changes(part, changes);
    CrumpleReportPart told;
    told.part = flow.part;
    told.added_faces = flow.partition->faces() - before;
    told.moved = crumpled.moves.count;
    told.largest_move = crumpled.moves.largest;
    told.root_mean_square = crumpled.moves.root_mean_square;
    const CrumpleReport report{{}, {std::move(told)}};
    context.report(fields_of<CrumpleReport>(declare_crumple_report), &report);
}

} // namespace facetmill::crumple_stage

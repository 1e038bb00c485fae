#include "stages/measure/cells.hpp"

#include "cells/process/measure_cells.hpp"
#include "stages/measure/report.hpp"

#include <algorithm>

namespace facetmill::measure_stage {

std::optional<std::string> why_not_on_cells(const MeasureOptions& o) {
    if (!o.attributes.empty()) return "attributes need the whole mesh in memory";
    if (std::any_of(o.path.begin(), o.path.end(), is_table))
        return "a table needs the whole mesh in memory, because cells do not keep the order of faces";
    return {};
}

void measure_on_cells(const MeasureOptions& o, CellFlow& flow, Context& context) {
    cells::CellMeasures all = cells::measure_cells(*flow.partition, flow.transform, flow.means,
                                                   {.feature_angle = o.feature_angle.radians});
    warn_of_inside_out(flow.part, all.mass, context);
    const auto solid = all.mass.solid ? std::optional(measured(*all.mass.solid, o.density)) : std::nullopt;
    MeasureReport report{to_string(flow.unit), o.density, {all.mass.shell, solid}, {}};
    report.parts.push_back(
        {flow.part, all.mass.shell, solid, std::move(all.faces), all.edges, std::move(all.curvature)});
    write_results(o, report, {}, context);
    context.report(fields_of<MeasureReport>(declare_measure_report), &report);
}

} // namespace facetmill::measure_stage

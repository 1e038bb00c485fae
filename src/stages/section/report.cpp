#include "stages/section/report.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/placement.hpp"
#include "report/summary.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill {

namespace {

void add_volume(Json& result, const Scene& scene, const io::DrawingTotals& totals, double spacing,
                Context& context) {
    if (!(spacing > 0)) return;
    std::optional<double> volume = 0.0;
    for (const Part& part : scene.parts) {
        if (!context.selects(part, scene)) continue;
        const auto own = inspect(part.mesh).volume;
        volume = volume && own ? std::optional(*volume + *own * std::abs(effective(part).determinant()))
                               : std::nullopt;
    }
    const double sum = totals.area * spacing;
    result["spacing"] = spacing;
    result["area_times_spacing"] = sum;
    result["volume"] = volume ? Json(*volume) : Json(nullptr);
    if (volume && *volume != 0) result["ratio"] = sum / *volume;
}

void warn(const io::DrawingTotals& totals, Context& context) {
    if (totals.open > 0)
        context.warn(
            "W-OPEN-SECTION",
            fmt::format("{} of {} contours are open: the mesh has a boundary where the plane cuts it",
                        totals.open, totals.contours),
            "use clean first, to weld the mesh or fill its holes");
    if (!totals.oriented)
        context.warn("W-UNORIENTED",
                     "neighbouring faces are inconsistent, so nesting decided which contours are outlines "
                     "and which are holes",
                     "use orient first");
    const auto crossed = totals.count(polygon::Kind::self_intersecting);
    if (crossed > 0)
        context.warn(
            "W-SECTION-CROSSES",
            fmt::format("{} contours intersect themselves and have no centroid and moments", crossed));
}

} // namespace

void report_sections(const io::Drawing& drawing, const Scene& scene, double spacing, Context& context) {
    const auto totals = io::totals_of(drawing);
    context.result() = io::summary_json(drawing, totals);
    add_volume(context.result(), scene, totals, spacing, context);
    context.say(report::section_summary(context.result(), to_string(scene.unit)));
    warn(totals, context);
}

} // namespace facetmill

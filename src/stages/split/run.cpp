#include "stage/grid_faces.hpp"
#include "stages/split/cells.hpp"
#include "stages/split/help.hpp"
#include "stages/split/options.hpp"
#include "stages/split/report.hpp"

#include <fmt/format.h>

namespace facetmill::split_stage {

namespace {

/// The part's share of the faces that all selected parts may have.
std::uint64_t share(const SplitOptions& o, const Part& part, double total) {
    if (!o.max_faces) return 0;
    const double mine = static_cast<double>(part.mesh.face_count());
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(static_cast<double>(*o.max_faces) * (total > 0 ? mine / total : 1)));
}

/// Runs split and adds the part's name to errors.
SplitResult split_part(const Part& part, const SplitSettings& settings) {
    try {
        return split(part.mesh, settings);
    } catch (const Error& e) {
        auto diagnostics = e.diagnostics();
        for (auto& d : diagnostics)
            if (e.kind() == ErrorKind::stage) d.message += fmt::format(" (part '{}')", part.name);
        throw Error(e.kind(), std::move(diagnostics));
    }
}

Scene run(Scene scene, const SplitOptions& o, Context& context, SplitReport& report) {
    SplitSettings settings = split_settings(o);
    if (o.chosen() == SplitMethod::grid) warn_of_crossing_faces_in_grid(scene, context);
    double total = 0;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) total += static_cast<double>(part.mesh.face_count());
    context.for_each_part(scene, [&](Part& part) {
        if (o.max_edge) settings.max_edge = context.resolve(*o.max_edge, scene, "max_edge", &part);
        if (o.max_edge && settings.max_edge <= 0) settings.passes = 0; // a percentage of a single point is 0
        settings.max_faces = share(o, part, total);
        settings.to_world = part.transform;
        const FacetShape before = facet_shape(part.mesh, settings.to_world);
        SplitResult result = split_part(part, settings);
        part.mesh = std::move(result.mesh);
        report.added_faces += result.added;
        const auto narrow = [&](std::size_t faces) { // counted only with min_angle
            return settings.min_angle > 0 ? std::optional(faces) : std::nullopt;
        };
        const FacetShape after = facet_shape(part.mesh, settings.to_world);
        warn_of_targets(part, result, settings, after.longest_edge, context);
        warn_of_spots(part, result, settings.method, context);
        report.parts.push_back({part.name, result.added, result.passes, stopped_by(o, result.stop),
                                narrow(result.narrow), narrow(result.narrow_before), before, after});
        context.attribute_changes(part, result.changes);
    });
    return scene;
}

struct SplitStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override { verify_split(o, given, problems); }
    /// Smooth methods converge to a surface inside the original corners, so any loss of area is intended.
    MayLose may_lose() const override { return is_smooth(o.chosen()) ? MayLose::area : MayLose::half; }
    /// A grid accepts at most four corners per face, so crossing faces cannot be filled.
    CrossingFacePolicy crossing_faces() const override {
        return o.chosen() == SplitMethod::grid ? CrossingFacePolicy::keep : CrossingFacePolicy::fill;
    }
    void on_cells(CellFlow& flow, Context& context) const override { split_on_cells(o, flow, context); }
    std::optional<std::string> why_not_on_cells() const override { return split_stage::why_not_on_cells(o); }
    double triangles_of_one() const override { return split_stage::triangles_of_one(o); }
};

const RegisterStage registered = make_stage<SplitStage>(
    {.name = "split",
     .also_called = "subdivide refine subdivision",
     .about = help::split::about,
     .details = help::split::details,
     .examples = {"split: midpoint", "split: {method: bisect, passes: 3}", "split: {grid: 3}",
                  "split: {max_edge: 2%}", "split: {method: loop, passes: 2, feature_angle: 30deg}"},
     .leaves_points = true,
     .may_lose = MayLose::half,
     .crossing_faces = CrossingFacePolicy::fill},
    declare_split, declare_split_report);

} // namespace

} // namespace facetmill::split_stage

#include "stage/grid_faces.hpp"
#include "stages/split/cells.hpp"
#include "stages/split/help.hpp"
#include "stages/split/options.hpp"
#include "stages/split/report.hpp"

#include <fmt/format.h>

namespace facetmill::split_stage {

namespace {

/// The part's share of max_faces, which all selected parts share.
std::uint64_t share(const SplitOptions& o, const Part& part, double total) {
    if (!o.max_faces) return 0;
    const double mine = static_cast<double>(part.mesh.face_count());
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(static_cast<double>(*o.max_faces) * (total > 0 ? mine / total : 1)));
}

/// Calls split and adds the part's name to its errors.
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
        if (o.max_edge && settings.max_edge <= 0) settings.passes = 0; // a percentage of a single point
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

/// Smooth methods approach a surface inside the original corners, by any amount.
MayLose may_lose(const SplitOptions& o) { return is_smooth(o.chosen()) ? MayLose::area : MayLose::half; }

/// A grid needs faces of at most four corners, so crossing faces cannot be filled.
CrossingFacePolicy crossing_faces(const SplitOptions& o) {
    return o.chosen() == SplitMethod::grid ? CrossingFacePolicy::keep : CrossingFacePolicy::fill;
}

const RegisterStage split_stage = make_stage<SplitOptions>(
    {.name = "split",
     .about = help::split::about,
     .details = help::split::details,
     .examples = {"split: midpoint", "split: {method: bisect, passes: 3}", "split: {grid: 3}",
                  "split: {max_edge: 2%}", "split: {method: loop, passes: 2, feature_angle: 30deg}"},
     .leaves_points = true,
     .may_lose = MayLose::half,
     .crossing_faces = CrossingFacePolicy::fill},
    declare_split, declare_split_report, run,
    {.verify = verify_split,
     .may_lose = may_lose,
     .crossing_faces = crossing_faces,
     .on_cells = split_on_cells,
     .why_not_on_cells = why_not_on_cells,
     .triangles_of_one = triangles_of_one});

} // namespace

} // namespace facetmill::split_stage

#include "base/progress.hpp"
#include "geometry/edit/moved.hpp"
#include "parallel/memory.hpp"
#include "stage/grid_faces.hpp"
#include "stage/stage.hpp"
#include "stages/crumple/cells.hpp"
#include "stages/crumple/help.hpp"
#include "stages/crumple/options.hpp"
#include "stages/crumple/report.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::crumple_stage {

namespace {

using Intersections = CrumpleOptions::Intersections;

SplitResult split_part(const Part& part, std::int64_t grid) {
    return grid_split(part.mesh, static_cast<int>(grid),
                      {fmt::format("crumple: part '{}', every face split {} x {}", part.name, grid, grid),
                       "use a smaller grid, simplify first, or give --memory: it can work on cells on disk"});
}

/// Refuses meshes before the split if avoiding intersections afterwards would be impossible.
void require_room(const Scene& scene, const CrumpleOptions& o, const Context& context) {
    if (o.self_intersections == Intersections::allow) return;
    double triangles = 0, largest = 0;
    for (const Part& part : scene.parts) {
        if (!context.selects(part, scene)) continue;
        const double own = static_cast<double>(part.mesh.corner_count()) - 2.0 * part.mesh.face_count();
        triangles += own;
        largest = std::max(largest, own);
    }
    const double pieces = static_cast<double>(o.grid) * static_cast<double>(o.grid);
    triangles *= pieces;
    require_memory(avoid_intersections_memory(triangles, largest * pieces),
                   fmt::format("crumple: avoiding intersections of {:.3g} triangles", triangles),
                   "use a smaller grid, or self_intersections: allow");
}

/// Moves all vertices as far as self_intersections allows.
void move(std::vector<CrumpledPart>& works, std::vector<CrumpleSheet>& sheets, const CrumpleOptions& o,
          CrumpleReport& report, Context& context) {
    hold_joint_vertices(sheets);
    if (o.self_intersections != Intersections::allow) {
        const bool forbid = o.self_intersections == Intersections::forbid;
        const AvoidResult r = avoid_intersections(sheets, forbid);
        if (r.left > 0) refuse_intersections(r, works, o.grid);
        warn_of_coarse_steps(r, context);
        report.self_intersections = r;
        return;
    }
    for (auto& sheet : sheets)
        for (std::size_t v = 0; v < sheet.moves.moves.size(); ++v)
            sheet.mesh->positions[v] += sheet.moves.moves[v];
}

Scene run(Scene scene, const CrumpleOptions& o, Context& context, CrumpleReport& report) {
    const auto amplitude = [&](const Part& part) {
        return context.resolve(o.amplitude, scene, "amplitude", &part);
    };
    double largest = 0;
    for (const Part& part : scene.parts) largest = std::max(largest, amplitude(part));
    CrumpleSettings settings = crumple_settings(o, scene, largest);
    require_room(scene, o, context);
    warn_of_crossing_faces_in_grid(scene, context);
    std::vector<CrumpledPart> works;
    std::vector<CrumpleSheet> sheets;
    MaskOfParts masks(scene, o.mask, o.caps);
    ProgressSteps steps({1, o.self_intersections != Intersections::allow ? 9.0 : 0.5, 1});
    context.for_each_part(scene, [&](Part& part) {
        settings.amplitude = amplitude(part);
        settings.to_world = part.transform;
        SplitResult pieces = split_part(part, o.grid);
        part.mesh = std::move(pieces.mesh);
        settings.mask = masks.of(part);
        sheets.push_back({&part.mesh, crumple_moves(part.mesh, settings)});
        works.push_back({&part, std::move(pieces), part.mesh.positions, settings.to_world});
        warn_of_folds(works.back(), context);
        if (o.self_intersections != Intersections::allow)
            warn_of_rounding(works.back(), sheets.back().moves, settings.amplitude, context);
        else if (o.frequency == 0)
            warn_of_tangles(part.name, mean_edge(part.mesh, settings.to_world), settings.amplitude, context);
    });
    masks.warn_if_idle(context);
    steps.next();
    move(works, sheets, o, report, context);
    steps.next();
    if (o.self_intersections != Intersections::allow) warn_of_parts(scene, context);
    for (std::size_t i = 0; i < works.size(); ++i) {
        Part& part = *works[i].part;
        CrumpleResult r = crumple_settled(std::move(part.mesh), works[i].before, works[i].to_world);
        part.mesh = o.triangulate ? triangulated(r.mesh) : std::move(r.mesh);
        context.attribute_changes(part, changes_in_sequence(works[i].pieces.changes, std::move(r.changes)));
        report.parts.push_back({std::move(r), part.name, works[i].pieces.added, sheets[i].moves.held});
    }
    return scene;
}

struct CrumpleStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override { verify_crumple(o, given, problems); }
    void on_cells(CellFlow& flow, Context& context) const override { crumple_on_cells(o, flow, context); }
    std::optional<std::string> why_not_on_cells() const override {
        return crumple_stage::why_not_on_cells(o);
    }
    double triangles_of_one() const override { return crumple_stage::triangles_of_one(o); }
};

const RegisterStage registered = make_stage<CrumpleStage>(
    {.name = "crumple",
     .also_called = "noise jitter displace",
     .about = help::crumple::about,
     .details = help::crumple::details,
     .examples = {"crumple: 0.2%", "crumple: {grid: 3, amplitude: 0.5mm, seed: 7}",
                  "crumple: {grid: 1, amplitude: 1%, direction: normal, boundary: fixed}",
                  "crumple: {grid: 4, amplitude: 1%, self_intersections: avoid}",
                  "crumple: {grid: 8, amplitude: 2%, frequency: 4, octaves: 6, direction: normal}"}},
    declare_crumple, declare_crumple_report);

} // namespace

} // namespace facetmill::crumple_stage

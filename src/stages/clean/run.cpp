#include "mesh/placement.hpp"
#include "stages/clean/options.hpp"
#include "stages/clean/report.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

void warn(const Part& part, const std::vector<NotDone>& all, Context& context) {
    if (all.empty()) return;
    context.warn("W-CLEAN",
                 fmt::format("clean: {} repairs of part '{}' were not done, the first in step '{}': {}",
                             all.size(), part.name, all[0].step, all[0].why),
                 "the report lists the first of them with their places");
}

Scene run(Scene scene, const CleanOptions& o, Context& context, CleanReport& report) {
    context.for_each_part(scene, [&](Part& part) {
        CleanResult r = clean(std::move(part.mesh), clean_settings(o, scene, part, context));
        part.mesh = std::move(r.mesh);
        context.ledger(part, r.fates);
        warn(part, r.not_done, context);
        report.parts.push_back({part.name, r.counts, first_not_done(r.not_done, effective(part))});
    });
    return scene;
}

const RegisterStage registered = make_stage<CleanOptions>(
    {.name = "clean",
     .about = "Repairs a mesh step by step, and leaves alone what is sound.",
     .details =
         "The steps, each on or off: weld, degenerate, duplicates, t_vertices, stitch, "
         "non_manifold, self_intersections, holes, components, shells, isolated; in this order, "
         "and again until nothing changes, so that cleaning twice changes nothing the second time. "
         "Those that need no judgement are on by default. What decides is exact: places, lines and "
         "planes are compared without a tolerance, unless a step is near.\n\n"
         "Faces that no step concerns keep their corners, attributes and order. Removing faces "
         "without area puts the vertices on their line onto the edges around, so that what was "
         "closed stays closed. Duplicate faces that look both ways go when they are a wall inside "
         "or a fin on other faces, and one of each stays when they are a sheet of their own (both, "
         "beside other pieces of a closed surface: it stays closed). Where more than two faces "
         "meet at an edge, those stay together that have the inside between them.\n\n"
         "self_intersections: union makes one solid of closed pieces that pass through each other or "
         "through themselves: their faces are cut along each other exactly, and what has the outside "
         "on one side (winding number 0 or less) and the inside on the other (1 or more) stays. Cut "
         "faces become triangles, all others stay as they are. Cavities (pieces turned inward, within "
         "a solid) are kept where no other solid fills them; a piece that is inside out elsewhere is "
         "left: orient first. New vertices are rounded to coordinates; where that makes faces "
         "intersect again, the union is repeated, up to eight times, and new vertices nearer to others than "
         "1e-15 "
         "of the size of the mesh, eight times as far in each repetition, become those. What does not end so "
         "is "
         "left as it was. local "
         "replaces faces that intersect place by place, if need be with up to four rings around "
         "them: where that would open the surface, change its topology, take half of a piece or "
         "leave an intersection, the place is left as it was.\n\n"
         "Holes that touch at a vertex are filled each for itself. A hole whose patch would not fit or "
         "would run into other faces, or whose neighbours disagree about the outside (orient first), "
         "is left; with self_intersections: union or all, a patch may run into other faces, which "
         "are united with it next. What is left is named in the report (W-CLEAN).\n\n"
         "Attributes of what stays are kept; at new vertices they are interpolated, and patches "
         "copy the face attributes from across their edge. The report counts what each step did.",
     .examples = {"clean", "clean: {holes: minimal, components: {faces: 10}}",
                  "clean: {self_intersections: union}", "clean: {weld: near, stitch: near, within: 0.01%}",
                  "clean: {holes: {method: smooth, edges: 50}, shells: true}"}},
    declare_clean, declare_clean_report, run, StageHooks<CleanOptions>{.files = {}, .verify = verify_clean});

} // namespace

} // namespace facetmill

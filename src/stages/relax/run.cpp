#include "geometry/edit/moved.hpp"
#include "mesh/placement.hpp"
#include "stages/relax/options.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace facetmill {

namespace {

Json size_json(const SurfaceSize& size) {
    return {{"area", size.area}, {"volume", size.volume ? Json(*size.volume) : Json()}};
}

Scene run(Scene scene, const RelaxOptions& o, Context& context) {
    RelaxSettings settings = relax_settings(o);
    MaskOfParts masks(scene, o.mask);
    Json parts = Json::array();
    context.for_each_part(scene, [&](Part& part) {
        settings.to_world = effective(part);
        if (o.until) // above 0 in a part that is a single point too, which settles at once
            settings.until = std::max(context.resolve(*o.until, scene, "until", &part),
                                      std::numeric_limits<double>::min());
        settings.mask = masks.of(part);
        const SurfaceSize before = surface_size(part.mesh, settings.to_world);
        RelaxResult r = relax(std::move(part.mesh), settings);
        part.mesh = std::move(r.mesh);
        context.ledger(part, r.fates);
        Json entry = {
            {"part", part.name},
            {"iterations", r.iterations},
            {"moved_vertices", r.moved},
            {"held_vertices", r.held},
            {"largest_move", r.largest_move},
            {"before", size_json(before)},
            {"after", size_json(surface_size(part.mesh, settings.to_world, before.volume.has_value()))}};
        if (o.until) entry["last_move"] = r.last_move, entry["settled"] = r.settled;
        if (o.until && !r.settled && r.iterations > 0)
            context.warn("W-RELAX-STOPPED",
                         fmt::format("part '{}' did not settle: the last of {} iterations moved a vertex by "
                                     "{:.4g}, more than until {:.4g}",
                                     part.name, r.iterations, r.last_move, settings.until),
                         "allow more iterations, or a larger until");
        parts.push_back(std::move(entry));
    });
    masks.warn_if_idle(context);
    context.result()["parts"] = std::move(parts);
    return scene;
}

const RegisterStage registered = make_stage<RelaxOptions>(
    {.name = "relax",
     .about = "Smooths a surface: every vertex moves towards the mean of its neighbours.",
     .details =
         "In each iteration P becomes P + factor / n * sum(Pj - P) over its n neighbours Pj, for all "
         "vertices at the same time, so neither their order nor the number of threads matters. A closed "
         "surface shrinks a little with every iteration of laplacian, cotangent and implicit; taubin and hc "
         "keep its volume nearly, and the report has area and volume before and after. Open, non-manifold "
         "and degenerate input is taken as it is: faces without area weigh nothing, a vertex without "
         "neighbours stays.\n\n"
         "Faces, wedges and topology stay, so Euler's number and closedness do. Normals are recomputed and "
         "tangents made perpendicular to them; morph targets of positions are relaxed with the surface, each "
         "as the surface it stands for; all other attributes are kept. The report has the number of moved "
         "and of held vertices and the largest move, in world units.\n\n"
         "Sources: the note 'Surface relaxation and smoothing' (1997); G. Taubin (1995); U. Pinkall and K. "
         "Polthier (1993); M. Desbrun and others (1999); J. Vollmer and others (1999).",
     .examples = {"relax: 3", "relax: {iterations: 10, factor: 0.5, boundary: slide}",
                  "relax: {method: taubin, iterations: 20, features: 30deg}",
                  "relax: {method: implicit, factor: 20}",
                  "relax: {until: 0.01%, mask: {material: \"skin*\"}}"}},
    declare_relax, run, {.verify = verify_relax});

} // namespace

} // namespace facetmill

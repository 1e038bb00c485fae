#include "geometry/edit/moved.hpp"
#include "stage/stage.hpp"
#include "stages/relax/help.hpp"
#include "stages/relax/options.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace facetmill::relax_stage {

namespace {

struct RelaxedPart : RelaxResult {
    std::string part;
    SurfaceSize before, after;
    bool until = false; ///< until was given
};

struct RelaxReport {
    std::vector<RelaxedPart> parts;
};

void declare_size(DeclareFields<SurfaceSize>& d) {
    d.field("area", &SurfaceSize::area, "The area of the surface.").unit("square scene units");
    d.field("volume", &SurfaceSize::volume, "The volume of the inside.")
        .unit("cubic scene units")
        .null_when("the surface is not closed");
}

void declare_part(DeclareFields<RelaxedPart>& d) {
    d.field("part", &RelaxedPart::part, "The name of the part.");
    d.field("iterations", &RelaxedPart::iterations, "The number of iterations.");
    d.field("moved_vertices", &RelaxedPart::moved, "Vertices that moved.");
    d.field(
        "held_vertices", &RelaxedPart::held,
        "Vertices that did not move because of the boundary, caps, corners of feature lines or the mask.");
    d.field("largest_move", &RelaxedPart::largest_move,
            "The largest distance of a vertex from its original position.")
        .unit("scene units");
    d.object("before", &RelaxedPart::before, "The size of the surface before.", declare_size);
    d.object("after", &RelaxedPart::after, "The size of the surface after.", declare_size);
    const auto last = [](const RelaxedPart& p) {
        return p.until ? std::optional(p.last_move) : std::nullopt;
    };
    d.field("last_move", last, "The largest movement in the last iteration.")
        .unit("scene units")
        .only_when("until is given");
    const auto settled = [](const RelaxedPart& p) {
        return p.until ? std::optional(p.settled) : std::nullopt;
    };
    d.field("settled", settled, "Whether relaxation reached until.").only_when("until is given");
}

void declare_report(DeclareFields<RelaxReport>& d) {
    d.list("parts", &RelaxReport::parts, "Each relaxed part.", declare_part);
}

Scene run(Scene scene, const RelaxOptions& o, Context& context, RelaxReport& report) {
    RelaxSettings settings = relax_settings(o);
    MaskOfParts masks(scene, o.mask, o.caps);
    context.for_each_part(scene, [&](Part& part) {
        settings.to_world = part.transform;
        if (o.until) // positive even for a part that is a single point
            settings.until = std::max(context.resolve(*o.until, scene, "until", &part),
                                      std::numeric_limits<double>::min());
        settings.mask = masks.of(part);
        const auto number = static_cast<std::size_t>(&part - scene.parts.data());
        const SurfaceSize before = context.size_before(scene, number);
        RelaxResult r = relax(std::move(part.mesh), settings);
        part.mesh = std::move(r.mesh);
        context.attribute_changes(part, r.changes);
        const SurfaceSize after = surface_size(part.mesh, settings.to_world, before.volume.has_value());
        context.keep_size(number, after);
        if (r.shrank)
            context.warn(
                "W-RELAX-STOPPED",
                fmt::format("part '{}' keeps shrinking: stopped after {} iterations, before a third of its "
                            "area was lost; the next would have moved a vertex by {:.4g}, more than until "
                            "{:.4g}",
                            part.name, r.iterations, r.last_move, settings.until),
                "use method: hc or taubin, which preserve the volume, or give iterations without until");
        else if (o.until && !r.settled && r.iterations > 0)
            context.warn("W-RELAX-STOPPED",
                         fmt::format("part '{}' did not converge: the last of {} iterations moved a vertex "
                                     "by {:.4g}, more than until {:.4g}",
                                     part.name, r.iterations, r.last_move, settings.until),
                         "allow more iterations, or a larger until");
        report.parts.push_back({std::move(r), part.name, before, after, o.until.has_value()});
    });
    masks.warn_if_idle(context);
    return scene;
}

struct RelaxStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override { verify_relax(o, given, problems); }
};

const RegisterStage registered =
    make_stage<RelaxStage>({.name = "relax",
                            .also_called = "smooth laplacian taubin fair",
                            .about = help::relax::about,
                            .details = help::relax::details,
                            .examples = {"relax: 3", "relax: {iterations: 10, lambda: 0.5, boundary: slide}",
                                         "relax: {method: taubin, iterations: 20, feature_angle: 30deg}",
                                         "relax: {method: implicit, lambda: 20}",
                                         "relax: {until: 0.01%, mask: {material: \"skin*\"}}"},
                            .leaves_points = true,
                            .may_lose = MayLose::half,
                            .crossing_faces = CrossingFacePolicy::fill},
                           declare_relax, declare_report);

} // namespace

} // namespace facetmill::relax_stage

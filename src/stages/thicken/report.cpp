#include "stages/thicken/report.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

void warn_of_walls(const Part& part, const ThickenResult& r, double thickness, bool looked,
                   Context& context) {
    if (r.unbalanced > 0)
        context.warn("W-THICKEN-OPEN",
                     fmt::format("thicken: part '{}' is not closed at {} edges: its surface is not oriented "
                                 "there",
                                 part.name, r.unbalanced),
                     "orient before it; a Moebius strip has no inside");
    if (r.thinnest < 0.5 * thickness)
        context.warn("W-THICKEN-THIN",
                     fmt::format("thicken: the wall of part '{}' is {:.6g} thin where it should be {:.6g}",
                                 part.name, r.thinnest, thickness),
                     "the surface bends or folds within the thickness there; try the other side or a smaller "
                     "thickness");
    if (r.self_intersections.value_or(0) > 0)
        context.warn("W-THICKEN",
                     fmt::format("thicken: {} pairs of faces of part '{}' intersect", *r.self_intersections,
                                 part.name),
                     "a smaller thickness, the other side, or a smoother surface (relax) avoids it");
    if (looked && !r.self_intersections)
        context.warn(
            "W-THICKEN",
            fmt::format("thicken: part '{}' is smaller than its thickness, {:.6g}: it was not looked "
                        "through for self-intersections",
                        part.name, thickness),
            "is the thickness in the right unit?");
}

} // namespace

Json described(const ThickenOptions& o, const Part& part, const ThickenResult& r, double thickness,
               Context& context) {
    Json entry = {{"part", part.name},
                  {"wall_faces", r.wall_faces},
                  {"limited_vertices", r.limited},
                  {"unmoved_vertices", r.still},
                  {"unbalanced_edges", r.unbalanced},
                  {"wall_thickness", {{"min", r.thinnest}, {"mean", r.mean}}}};
    if (part.mesh.face_count() == 0) return entry;
    if (o.self_intersections)
        entry["self_intersections"] = r.self_intersections ? Json(*r.self_intersections) : Json(nullptr);
    warn_of_walls(part, r, thickness, o.self_intersections, context);
    context.say(
        fmt::format("{}: wall thickness {:.6g} at least, {:.6g} in the mean{}", part.name, r.thinnest, r.mean,
                    r.self_intersections ? fmt::format(", {} self-intersections", *r.self_intersections)
                                         : std::string()));
    return entry;
}

Json described(const Part& part, const WiresResult& r, Context& context) {
    context.say(fmt::format("{}: {} cylinders", part.name, r.edges));
    return {{"part", part.name}, {"cylinders", r.edges}, {"without_length", r.skipped}};
}

} // namespace facetmill

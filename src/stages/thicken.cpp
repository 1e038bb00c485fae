#include "geometry/thicken.hpp"

#include "mesh/inverse.hpp"
#include "mesh/placement.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class What { surface, edges, open_edges };

struct ThickenOptions {
    Length thickness;
    ThickenSide side = ThickenSide::inward;
    What what = What::surface;
    double corner_limit = 3;
    std::int64_t sides = 8;
    bool self_intersections = true;
};

void declare(Declare<ThickenOptions>& d) {
    d.option("thickness", &ThickenOptions::thickness, "Of the solid; the diameter of cylinders.")
        .above(0)
        .required()
        .primary();
    d.choice<ThickenSide>(
        "side", &ThickenOptions::side,
        {{"inward", ThickenSide::inward, "behind the front, which stays where it is"},
         {"outward", ThickenSide::outward, "before it; what was the front is the back's place"},
         {"centred", ThickenSide::centred, "half of it on either side"}},
        "Where the thickness goes.");
    d.choice<What>("what", &ThickenOptions::what,
                   {{"surface", What::surface, "a shell with walls along open edges"},
                    {"edges", What::edges, "every edge becomes a cylinder, and the faces go"},
                    {"open-edges", What::open_edges, "only open edges do"}},
                   "What becomes thick.");
    d.option("corner_limit", &ThickenOptions::corner_limit,
             "A vertex at a sharp corner moves at most so many times the thickness (a factor).")
        .between(1, 100);
    d.option("sides", &ThickenOptions::sides, "Of each cylinder (a count).").between(3, 360);
    d.option("self_intersections", &ThickenOptions::self_intersections,
             "Looks for them in the result and says so.");
}

Json thicken_surface(Part& part, const ThickenOptions& o, double thickness, Context& context) {
    ThickenResult r =
        thicken(part.mesh, {thickness, o.side, o.corner_limit, o.self_intersections, effective(part)});
    part.mesh = std::move(r.mesh);
    context.ledger(part, r.fates);
    Json entry = {{"part", part.name},
                  {"wall_faces", r.wall_faces},
                  {"limited_vertices", r.limited},
                  {"unmoved_vertices", r.still},
                  {"unbalanced_edges", r.unbalanced},
                  {"wall_thickness", {{"min", r.thinnest}, {"mean", r.mean}}}};
    if (part.mesh.face_count() == 0) return entry;
    if (r.unbalanced > 0)
        context.warn("W-THICKEN-OPEN",
                     fmt::format("thicken: part '{}' is not closed at {} edges: its surface is not oriented "
                                 "there, or has edges of more than two faces",
                                 part.name, r.unbalanced),
                     "orient and clean before it; a Moebius strip has no inside");
    if (r.thinnest < 0.5 * thickness)
        context.warn("W-THICKEN-THIN",
                     fmt::format("thicken: the wall of part '{}' is {:.6g} thin where it should be {:.6g}",
                                 part.name, r.thinnest, thickness),
                     "the surface bends or folds within the thickness there; try the other side or a smaller "
                     "thickness");
    context.say(fmt::format(
        "{}: wall thickness {:.6g} at least, {:.6g} in the mean{}", part.name, r.thinnest, r.mean,
        o.self_intersections ? fmt::format(", {} self-intersections", r.self_intersections) : std::string()));
    if (!o.self_intersections) return entry;
    entry["self_intersections"] = r.self_intersections;
    if (r.self_intersections > 0)
        context.warn(
            "W-THICKEN",
            fmt::format("thicken: {} pairs of faces of part '{}' intersect", r.self_intersections, part.name),
            "a smaller thickness, the other side, or a smoother surface (relax) avoids it");
    return entry;
}

Json thicken_edges(Part& part, const ThickenOptions& o, double thickness, Context& context) {
    WiresResult r =
        wires(part.mesh, {thickness, static_cast<int>(o.sides), o.what == What::open_edges, effective(part)});
    Fates fates;
    for (const auto& a : part.mesh.attributes)
        fates.push_back({a.name, a.domain, Fate::Kind::dropped, "cylinders have no attributes"});
    context.ledger(part, fates);
    part.mesh = std::move(r.mesh);
    context.say(fmt::format("{}: {} cylinders", part.name, r.edges));
    return {{"part", part.name}, {"cylinders", r.edges}, {"without_length", r.skipped}};
}

Scene run(Scene scene, const ThickenOptions& o, Context& context) {
    Json parts = Json::array();
    context.for_each_part(scene, [&](Part& part) {
        const double thickness = context.resolve(o.thickness, scene, "thickness", &part);
        if (!inverse(effective(part)))
            throw Error(ErrorKind::stage, "E-THICKEN",
                        fmt::format("thicken: part '{}' is flattened by its node", part.name),
                        "transform: {bake: true} makes it a flat mesh");
        if (!(thickness > 0))
            throw Error(ErrorKind::stage, "E-THICKEN", "thicken: the thickness is 0 in this scene",
                        "give a length in scene units");
        parts.push_back(o.what == What::surface ? thicken_surface(part, o, thickness, context)
                                                : thicken_edges(part, o, thickness, context));
    });
    context.result()["parts"] = std::move(parts);
    return scene;
}

const RegisterStage registered = make_stage<ThickenOptions>(
    {.name = "thicken",
     .about = "Gives a surface a thickness: it becomes a closed solid; or makes cylinders of its edges.",
     .details = "A copy of the surface, turned round, stands at the thickness behind it, and walls close the "
                "open edges. A "
                "closed surface becomes a hollow solid. Every vertex moves so that the planes of its faces "
                "move by the "
                "thickness, as nearly as one point allows: flat walls keep their thickness up to their "
                "corners. Sharp corners "
                "are held back by corner_limit. The surface has to be oriented (orient) for the solid to be "
                "closed (W-THICKEN-OPEN).\n\n"
                "The result is looked through for self-intersections (W-THICKEN), and the wall is measured, "
                "from the vertices "
                "of the front to the faces of the back; the report has both. Attributes are kept on both "
                "sides, normals "
                "turned on the back; walls have the attributes of their edge and normals of their own.\n\n"
                "Source: the note on facets, which doubles a surface and makes cylinders of lines.",
     .examples = {"thicken: 2mm", "thicken: {thickness: 1%, side: centred}",
                  "thicken: {thickness: 0.5%, what: edges, sides: 6}"}},
    declare, run);

} // namespace

} // namespace facetmill

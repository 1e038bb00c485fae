#include "mesh/inverse.hpp"
#include "mesh/placement.hpp"
#include "stages/thicken/report.hpp"

#include <fmt/format.h>
#include <utility>

namespace facetmill {

namespace {

using What = ThickenOptions::What;

ThickenedPart thicken_surface(Part& part, const ThickenOptions& o, double thickness, Context& context) {
    ThickenResult r =
        thicken(part.mesh, {thickness, o.side, o.corner_limit, o.self_intersections, effective(part)});
    part.mesh = std::move(r.mesh);
    context.ledger(part, r.fates);
    const bool has_faces = part.mesh.face_count() > 0;
    if (has_faces) warn_of_walls(part, r, thickness, o.self_intersections, context);
    return ThickenedSurface{part.name, std::move(r), has_faces, o.self_intersections};
}

ThickenedPart thicken_edges(Part& part, const ThickenOptions& o, double thickness, Context& context) {
    WiresResult r =
        wires(part.mesh, {thickness, static_cast<int>(o.sides), o.what == What::open_edges, effective(part)});
    Fates fates;
    for (const auto& a : part.mesh.attributes)
        fates.push_back({a.name, a.domain, Fate::Kind::dropped, "cylinders have no attributes"});
    context.ledger(part, fates);
    part.mesh = std::move(r.mesh);
    if (std::exchange(part.skinned, false)) {
        part.transform = {};
        context.warn("W-SKIN",
                     fmt::format("thicken: the cylinders of part '{}' stand in bind pose, without its skin",
                                 part.name));
    }
    return ThickenedEdges{part.name, r.edges, r.skipped};
}

Scene run(Scene scene, const ThickenOptions& o, Context& context, ThickenReport& report) {
    context.for_each_part(scene, [&](Part& part) {
        const double thickness = context.resolve(o.thickness, scene, "thickness", &part);
        if (!inverse(effective(part)))
            throw Error(ErrorKind::stage, "E-THICKEN",
                        fmt::format("thicken: part '{}' is flattened by its node", part.name),
                        "transform: {bake: true} makes it a flat mesh");
        if (!(thickness > 0))
            throw Error(ErrorKind::stage, "E-THICKEN", "thicken: the thickness is 0 in this scene",
                        "give a length in scene units");
        report.parts.push_back(o.what == What::surface ? thicken_surface(part, o, thickness, context)
                                                       : thicken_edges(part, o, thickness, context));
    });
    return scene;
}

const RegisterStage registered = make_stage<ThickenOptions>(
    {.name = "thicken",
     .about = "Gives a surface a thickness: it becomes a closed solid; or makes cylinders of its edges.",
     .details =
         "A copy of the surface, turned round, stands at the thickness behind it, and walls close the "
         "open edges. A closed surface becomes a hollow solid. Every vertex moves so that the planes "
         "of its faces move by the thickness, as nearly as one point allows: flat walls keep their "
         "thickness up to their corners. Sharp corners are held back by corner_limit. The surface has "
         "to be oriented (orient) for the solid to be closed (W-THICKEN-OPEN). Sheets that meet at an "
         "edge of more than two faces, or only at a vertex, become solids of their own.\n\n"
         "The result is looked through for self-intersections (W-THICKEN), unless the thickness is more "
         "than the part is large, and the wall is measured, from the vertices of the front to the "
         "faces of the back; the report has both. Attributes "
         "are kept on both sides, normals turned on the back; walls have the attributes of their edge "
         "and normals of their own.\n\n"
         "Source: the note on facets, which doubles a surface and makes cylinders of lines.",
     .examples = {"thicken: 2mm", "thicken: {thickness: 1%, side: centred}",
                  "thicken: {thickness: 0.5%, what: edges, sides: 6}"}},
    declare_thicken, declare_thicken_report, run);

} // namespace

} // namespace facetmill

#include "mesh/placement.hpp"
#include "stages/split/options.hpp"
#include "stages/split/report.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

/// The part's share of the faces that all selected parts may have.
std::uint64_t share(const SplitOptions& o, const Part& part, double total) {
    if (!o.faces) return 0;
    const double mine = static_cast<double>(part.mesh.face_count());
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(static_cast<double>(*o.faces) * (total > 0 ? mine / total : 1)));
}

/// split, whose refusals name the part.
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
    double total = 0;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) total += static_cast<double>(part.mesh.face_count());
    context.for_each_part(scene, [&](Part& part) {
        if (o.max_edge) settings.max_edge = context.resolve(*o.max_edge, scene, "max_edge", &part);
        if (o.max_edge && settings.max_edge <= 0) settings.passes = 0; // a percentage of a single point
        settings.faces = share(o, part, total);
        settings.to_world = effective(part);
        const FacetShape before = facet_shape(part.mesh, settings.to_world);
        SplitResult result = split_part(part, settings);
        part.mesh = std::move(result.mesh);
        report.added_faces += result.added;
        const FacetShape after = facet_shape(part.mesh, settings.to_world);
        warn_of_targets(part, result, settings, after.longest_edge, context);
        warn_of_spots(part, result, settings.method, context);
        report.parts.push_back(
            {part.name, result.added, result.passes, stopped_by(o, result.stop), before, after});
        context.ledger(part, result.fates);
    });
    return scene;
}

const RegisterStage split_stage = make_stage<SplitOptions>(
    {.name = "split",
     .about = "Splits faces into smaller ones, without cracks.",
     .details =
         "The surface stays where it is and becomes finer; the smooth methods move it. A point on an edge is "
         "one vertex for all faces at that edge, on open, closed and non-manifold meshes, so there are no "
         "cracks and no T-vertices, and closed stays closed. Euler's number and manifoldness stay too, but "
         "where two faces share two edges: new edges across such a corner are one edge of both and have more "
         "than two faces (W-SPLIT-SHARED has the count). varignon leaves such corners whole, diagonal takes "
         "the other diagonal where it can. Seams stay seams: there is one new wedge per edge and pair of "
         "wedges.\n\n"
         "Concave quads are cut to a point that all of the quad is seen from, but for halve, varignon and "
         "grid; there, and in concave faces of five corners and more, pieces may lie over each other "
         "(W-SPLIT-FOLDED has the count).\n\n"
         "Where a method cuts some edges of a face only, neighbours follow: bisect cuts every triangle with "
         "a cut edge at its longest edge too (Rivara's rule), into two, three or four; notch and halve cut a "
         "neighbouring triangle to the opposite corner, in a triangle and a quad, or in four, and a "
         "neighbouring quad in up to four. Between passes of notch quads are cut along a diagonal. Methods "
         "for triangles or quads only refuse larger faces by number (E-POLYGON).\n\n"
         "Smooth methods need a manifold, consistently oriented mesh (E-MANIFOLD says where it is not). "
         "Boundaries and creases become smooth curves; corners of three or more creases stay.\n\n"
         "Vertex and wedge attributes are interpolated, face attributes are copied to the faces that replace "
         "a face; after smooth methods normals are recomputed. Old vertices keep their numbers. A result of "
         "more than 2^31 corners (E-LIMIT) or more than there is memory for (E-MEMORY) is refused before "
         "anything is built. Targets end at passes at the latest; the report says what stopped the split "
         "(passes, max_edge, min_angle or faces), and W-SPLIT-STOPPED and W-SPLIT-NOTHING tell of targets "
         "that were not reached. The report has the longest edge and the smallest angle before and after, in "
         "world units and degrees.\n\n"
         "Sources: the note 'Splitting facets' (1991); M.-C. Rivara (1984), I. Rosenberg and F. Stenger "
         "(1975); C. Loop (1987), L. Kobbelt (2000), D. Zorin, P. Schroeder and W. Sweldens (1996), E. "
         "Catmull and J. Clark (1978), H. Hoppe and others (1994) for creases.",
     .examples = {"split: midpoint", "split: {method: bisect, passes: 3}", "split: {grid: 3}",
                  "split: {max_edge: 2%}", "split: {method: loop, passes: 2, creases: 30deg}"}},
    declare_split, declare_split_report, run, {.verify = verify_split});

} // namespace

} // namespace facetmill

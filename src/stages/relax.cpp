#include "geometry/relax.hpp"

#include "stage/stage.hpp"

namespace facetmill {

namespace {

using Neighbours = RelaxSettings::Neighbours;
using Boundary = RelaxSettings::Boundary;

void declare(Declare<RelaxSettings>& d) {
    d.option("iterations", &RelaxSettings::iterations,
             "How many times all vertices move (a count); 0 leaves the mesh as it is.")
        .between(0, 1000000)
        .primary();
    d.option("factor", &RelaxSettings::factor,
             "How far each vertex goes towards the mean of its neighbours: 1 is all the way (a share, "
             "without unit).")
        .above(0)
        .at_most(1);
    d.choice<Neighbours>(
        "neighbours", &RelaxSettings::neighbours,
        {{"faces", Neighbours::faces,
          "the vertices of all faces that share the vertex, each once: the far corner of a quad counts"},
         {"edges", Neighbours::edges, "the vertices joined to it by an edge"}},
        "Which vertices pull.");
    d.choice<Boundary>(
        "boundary", &RelaxSettings::boundary,
        {{"fixed", Boundary::fixed, "they stay, and so does the outline of an open surface"},
         {"slide", Boundary::slide, "they are averaged with their neighbours along the boundary only"},
         {"free", Boundary::free, "they move as all others: an open surface shrinks"}},
        "What boundary vertices do: those on an edge with exactly one face.");
}

Scene run(Scene scene, const RelaxSettings& settings, Context& context) {
    Json parts = Json::array();
    context.for_each_part(scene, [&](Part& part) {
        RelaxResult r = relax(std::move(part.mesh), settings);
        part.mesh = std::move(r.mesh);
        context.ledger(part, r.fates);
        parts.push_back({{"part", part.name},
                         {"moved_vertices", r.moved},
                         {"held_vertices", r.held},
                         {"largest_move", r.largest_move}});
    });
    context.result()["parts"] = std::move(parts);
    return scene;
}

const RegisterStage registered = make_stage<RelaxSettings>(
    {.name = "relax",
     .about = "Smooths a surface: every vertex moves towards the mean of its neighbours.",
     .details =
         "In each iteration P becomes P + factor / n * sum(Pj - P) over its n neighbours Pj, for all "
         "vertices at the "
         "same time, so neither their order nor the number of threads matters. A closed surface shrinks a "
         "little "
         "with every iteration. Open, non-manifold and degenerate input is taken as it is; a vertex without "
         "neighbours stays.\n\n"
         "Faces, wedges and topology stay, so Euler's number and closedness do. Normals are recomputed and "
         "tangents "
         "made perpendicular to them; all other attributes are kept, morph targets too: their displacements "
         "are not "
         "smoothed. The report has the number of moved and of held vertices and the largest move, in the "
         "part's "
         "units.\n\n"
         "Source: the note 'Surface relaxation and smoothing' (1997).",
     .examples = {"relax: 3", "relax: {iterations: 10, factor: 0.5, boundary: slide}",
                  "relax: {neighbours: edges}"}},
    declare, run);

} // namespace

} // namespace facetmill

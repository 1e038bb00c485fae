#include "geometry/split.hpp"

#include "stage/stage.hpp"

namespace facetmill {

namespace {

struct SplitOptions {
    SplitMethod method = SplitMethod::midpoint;
    std::optional<std::int64_t> grid;
    std::int64_t passes = 1;
};

void declare(Declare<SplitOptions>& d) {
    d.choice<SplitMethod>(
         "method", &SplitOptions::method,
         {{"midpoint", SplitMethod::midpoint,
           "edges halved: a triangle becomes 4 triangles, a quad 4 quads, an n-gon n quads"},
          {"bisect", SplitMethod::bisect,
           "triangles cut across their longest edge: 2 triangles, 3 or 4 where neighbours cut the other "
           "edges"},
          {"centroid", SplitMethod::centroid,
           "triangles from every edge to the centroid: a triangle becomes 3, a quad 4 (a fan)"},
          {"grid", SplitMethod::grid, "triangles into n * n triangles, quads into n x n quads; see grid"},
          {"quads", SplitMethod::quads, "quads around the centroid: a triangle becomes 3, a quad 4"},
          {"varignon", SplitMethod::varignon,
           "the polygon of the edges' midpoints and a triangle at every corner: a quad becomes 5 faces"},
          {"core", SplitMethod::core,
           "the same shape at half size and a quad along every edge: a triangle becomes 4 faces"},
          {"diagonal", SplitMethod::diagonal, "quads into 2 triangles along their shorter diagonal"}},
         "How faces are split.")
        .primary();
    d.option("grid", &SplitOptions::grid,
             "How many pieces each edge is cut into (a count); every face becomes n x n. Implies the method "
             "grid.")
        .between(1, 10000);
    d.option("passes", &SplitOptions::passes, "How many times the split is repeated (a count).")
        .between(0, 30);
}

void verify(const SplitOptions& o, const Value& given, Problems& problems) {
    const Value* method = given.is_map() ? given.find("method") : &given;
    if (o.grid && method && !method->is_null() && o.method != SplitMethod::grid)
        problems.add(method->mark, "E-EXCLUSIVE", "split: 'grid' goes with the method grid only",
                     "leave out either method or grid");
    if (o.method == SplitMethod::grid && !o.grid)
        problems.add(given.mark, "E-MISSING",
                     "split: the method grid needs 'grid', the number of pieces per edge",
                     "for example split: {grid: 3}");
}

Scene run(Scene scene, const SplitOptions& o, Context& context) {
    const SplitSettings settings{o.grid ? SplitMethod::grid : o.method, static_cast<int>(o.passes),
                                 static_cast<int>(o.grid.value_or(2))};
    std::size_t added = 0;
    context.for_each_part(scene, [&](Part& part) {
        SplitResult result = split(part.mesh, settings);
        part.mesh = std::move(result.mesh);
        added += result.added;
        context.ledger(part, result.fates);
    });
    context.result()["added_faces"] = added;
    return scene;
}

const RegisterStage split_stage = make_stage<SplitOptions>(
    {.name = "split",
     .about = "Splits faces into smaller ones, without cracks.",
     .details =
         "The surface stays where it is and becomes finer. A point on an edge is one vertex for all faces at "
         "that edge, on open, closed and non-manifold meshes, so there are no cracks and no T-vertices; "
         "closed "
         "stays closed and Euler's number stays. Seams stay seams: there is one new wedge per edge and pair "
         "of "
         "wedges.\n\n"
         "The method bisect cuts every triangle across its longest edge and, where a neighbour's longest "
         "edge "
         "is another of its edges, across that one too (Rivara's rule), so a triangle becomes two, three or "
         "four.\n\n"
         "Vertex and wedge attributes are interpolated, face attributes are copied to the faces that replace "
         "a "
         "face. Old vertices keep their places. A result of more than 2^31 corners is refused before "
         "anything "
         "is built (E-LIMIT).\n\n"
         "Source: the note on facet splitting; M.-C. Rivara (1984) for the closure of bisect.",
     .examples = {"split: midpoint", "split: {method: bisect, passes: 3}", "split: {grid: 3}"}},
    declare, run, StageHooks<SplitOptions>{.files = {}, .verify = verify});

} // namespace

} // namespace facetmill

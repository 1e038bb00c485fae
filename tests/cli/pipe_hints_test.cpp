#include "support/catch.hpp"

#include "cli/pipe_hints.hpp"

using facetmill::cli::in_pipe_syntax;

TEST_CASE("hints name stages and options as pipe takes them", "[cli]") {
    struct Case {
        const char *yaml, *pipe;
    };
    const Case cases[] = {
        {"give unit and up axis when you load the mesh: load: {path: ..., unit: mm, up: z}",
         "give unit and up axis when you load the mesh: load ... --unit mm --up z"},
        {"write 10%, or name the option for a count (faces: 10)",
         "write 10%, or name the option for a count (--faces 10)"},
        {"the common key when: {faces: {min: 1}} skips a write",
         "the common key --when.faces.min 1 skips a write"},
        {"clean: {self_intersections: all} unites or replaces",
         "clean --self_intersections all unites or replaces"},
        {"clean: {holes: {method: smooth, max_edges: 5}}, then orient",
         "clean --holes.method smooth --holes.max_edges 5, then orient"},
        {"transform: {bake: true} makes it flat", "transform --bake makes it flat"},
        {"transform: {translate: [0, 0, 1], scale: ...} first",
         "transform --translate '[0, 0, 1]' --scale ... first"},
        {"use self_intersections: avoid, or less", "use --self_intersections avoid, or less"},
        {"max_quadric_error: off simplifies; precision: full keeps",
         "--max_quadric_error off simplifies; --precision full keeps"},
        {"origin: auto, or mesh_manifold: true; method: magic",
         "--origin auto, or --mesh_manifold; method: magic"},
        {"faces: 10 of them, keep: what is there", "--faces 10 of them, keep: what is there"},
        {"give it: tolerance: 0.01%, or more", "give it: --tolerance 0.01%, or more"},
        {"give a direction: from: [1, -2, 1]", "give a direction: --from '[1, -2, 1]'"},
        {"give a direction: plane: {normal: [0, 0, 1]}", "give a direction: --plane.normal '[0, 0, 1]'"},
        {"begin with load: FILE", "begin with load FILE"},
        {"give the unit: load: {path: ..., unit: mm}", "give the unit: load ... --unit mm"},
        {"expected one of: path, format", "expected one of: path, format"},
        {"units: um, mm, or %", "units: um, mm, or %"},
        {"it was {a: b", "it was {a: b"},
        {"load: {path", "load: {path"},
        {"write ${lod}, without blanks", "write @{lod}, without blanks"},
        {"for a literal ${ write $${", "for a literal @{ write @@{"},
        {"it costs 5$", "it costs 5$"},
        {"", ""},
    };
    for (const Case& c : cases) CHECK(in_pipe_syntax(c.yaml) == c.pipe);
}

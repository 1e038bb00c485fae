#include "stages/simplify/parts.hpp"

namespace facetmill {

namespace {

// clang-format off: it breaks lines of text in odd places
constexpr const char* details =
    "Edges are collapsed, cheapest first, until a target is met; with several targets the first one met "
    "stops the work, and the report names it, with the ratio achieved and what holds the edges that are "
    "left. Polygons are triangulated first. The method quadric measures the squared distance to the "
    "planes of all faces that a vertex stands for, weighted by area; shortest-edge is the note's. "
    "Collapses run in passes of equal threshold, so the order is that of the costs but for vertices "
    "that a pass has touched already.\n\n"
    "Guaranteed: a closed manifold stays closed and manifold, genus, components and boundary loops "
    "stay, no face turns by more than 60 degrees in a collapse, none becomes degenerate or doubled. "
    "Boundaries, UV seams, sharp normal seams and borders of materials and groups collapse only along "
    "themselves and stay matched; where several meet, the vertex stays. So do open borders that touch "
    "at exactly the same places, within a part and between parts: parts of the same node transform, "
    "attributes and shading whose borders touch are simplified as one, to the target of all together; "
    "where a part touches another that does not fit, or that is not selected, its vertices stay. Non-"
    "manifold and inconsistently oriented places are left as they are. Isolated vertices are dropped. "
    "With topology: allow components may vanish, holes close and handles be pinched off, which can "
    "leave edges of four faces; the report has the counts before and after. The method cluster keeps "
    "neither topology nor borders, and says so the same way.\n\n"
    "UVs, normals, colours and skin weights enter the error of the quadric methods with weights. A "
    "vertex that moved has the attributes of the surface that came in, at the nearest point of the "
    "faces that it replaces, so textures do not slide; faces keep theirs. Wedges that differ in normals "
    "only are merged below the crease angle; a flat-shaded mesh gets the normals of its new faces.\n\n"
    "max_error is a bound on the measured deviation: 100,000 samples each way and all vertices, seed 1, "
    "as reported under deviation, in scene units and in percent of the part's diagonal. Points of the "
    "surface are followed while it is simplified, and what is above the bound in the end is taken back "
    "collapse by collapse. It takes many times as long as a ratio. cluster meets it by the size of its "
    "cells.\n\n"
    "lods makes one chain: each level is reached by further collapses from the one before. write: "
    "{path: x.glb, lods: true} puts them into one file as MSFT_lod, without lods as nodes side by side; "
    "only: \"*.lod1\" writes a level into a file of its own.\n\n"
    "The method constrained keeps boundaries, seams and borders vertex by vertex.\n\n"
    "largest_error is, for quadric and cluster, the largest root mean square distance of a new vertex "
    "to its planes; for shortest-edge half the longest edge collapsed; for constrained null. A target "
    "at or above the input does nothing (W-SIMPLIFY-NOTHING); when no collapse is left the work stops "
    "and says why (W-SIMPLIFY-STOPPED). self_intersections: avoid does all again with half the error "
    "allowed to what runs into itself, up to ten times, then holds it as it came, up to six times; the "
    "count that is left is reported.\n\n"
    "Sources: the note 'Surface simplification' (1997); M. Garland and P. Heckbert, 'Surface "
    "simplification using quadric error metrics' (1997); H. Hoppe, 'New quadric metric for simplifying "
    "meshes with appearance attributes' (1999); J. Rossignac and P. Borrel (1993) and P. Lindstrom "
    "(2000) for cluster.";
// clang-format on

const RegisterStage registered = make_stage<SimplifyOptions>(
    {.name = "simplify",
     .about = "Reduces the number of faces and keeps the shape, the topology and the attributes.",
     .details = details,
     .examples = {"simplify: 25%", "simplify: {faces: 5000, lock: [boundary, seams]}",
                  "simplify: {ratio: 5%, max_error: 0.1%}", "simplify: {lods: [100%, 50%, 10%]}",
                  "simplify: {ratio: 10%, method: shortest-edge}",
                  "simplify: {ratio: 2%, method: cluster, measure: false}",
                  "simplify: {ratio: 20%, weights: {uv: 2, colour: 0}, topology: allow}"}},
    declare_simplify, simplify_parts, {.verify = verify_simplify});

} // namespace

} // namespace facetmill

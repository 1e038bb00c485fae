#include "stages/simplify/cells.hpp"
#include "stages/simplify/help.hpp"
#include "stages/simplify/parts.hpp"

namespace facetmill::simplify_stage {

namespace {

const RegisterStage registered = make_stage<SimplifyOptions>(
    {.name = "simplify",
     .also_called = "decimate decimation reduce quadric qem",
     .about = help::simplify::about,
     .details = help::simplify::details,
     .examples = {"simplify: 25%", "simplify: {faces: 5000, lock: [boundary, seams]}",
                  "simplify: {ratio: 5%, max_error: 0.1%}", "simplify: {lods: [100%, 50%, 10%]}",
                  "simplify: {ratio: 10%, method: shortest-edge}",
                  "simplify: {ratio: 2%, method: cluster, measure: false}",
                  "simplify: {ratio: 20%, weights: {uv: 2, colour: 0}, topology: allow}"},
     .measures_deviation = true,
     .may_lose = MayLose::half,
     .crossing_faces = CrossingFacePolicy::fill,
     .ends_cells = true},
    declare_simplify, declare_simplify_report, simplify_parts,
    {.verify = verify_simplify, .on_cells = simplify_on_cells, .why_not_on_cells = why_not_on_cells});

} // namespace

} // namespace facetmill::simplify_stage

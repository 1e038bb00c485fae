#include "stages/simplify/cells.hpp"
#include "stages/simplify/help.hpp"
#include "stages/simplify/parts.hpp"

namespace facetmill::simplify_stage {

namespace {

struct SimplifyStage : StageOf<simplify_parts> {
    void verify(const Value& given, Problems& problems) const override {
        verify_simplify(o, given, problems);
    }
    void on_cells(CellFlow& flow, Context& context) const override { simplify_on_cells(o, flow, context); }
    std::optional<std::string> why_not_on_cells() const override {
        return simplify_stage::why_not_on_cells(o);
    }
};

const RegisterStage registered = make_stage<SimplifyStage>(
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
    declare_simplify, declare_simplify_report);

} // namespace

} // namespace facetmill::simplify_stage

#include "pipeline/cells.hpp"

#include "base/readable_numbers.hpp"
#include "cells/face_source.hpp"
#include "cells/hierarchy.hpp"

#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

[[noreturn]] void refuse_cells(const std::string& what, const std::string& why, const std::string& hint,
                               const Mark& where) {
    throw Error(ErrorKind::usage, "E-CELLS", fmt::format("{}: {}", what, why), hint, where);
}

/// What a step has around its stage that looks at the scene.
const char* key_in_the_way(const Step& step) {
    if (step.when && !step.when->known) return "when";
    if (step.ensure) return "ensure";
    if (!step.only.patterns.empty()) return "only";
    return nullptr;
}

std::vector<std::string> stages_on_cells() {
    std::vector<std::string> names;
    for (const StageInfo& stage : stages())
        if (stage.on_cells) names.push_back(stage.name);
    return names;
}

/// How many of the first steps work on cells: up to the one that makes the mesh small, or all.
std::size_t steps_on_cells(const Steps& steps, const std::string& what, const std::string& way_out) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Step& step = steps[i];
        if (step.kind != Step::Kind::stage || !step.stage->on_cells)
            refuse_cells(
                what, fmt::format("'{}' cannot work on a mesh in cells", step.name),
                fmt::format("put it after simplify or clip, which make the mesh small, or {} ({} can)",
                            way_out, fmt::join(stages_on_cells(), ", ")),
                step.where);
        if (step.when && step.when->known && !*step.when->known)
            refuse_cells(what, fmt::format("'{}' is skipped", step.name), "leave the step out, or " + way_out,
                         step.where);
        if (const char* key = key_in_the_way(step))
            refuse_cells(
                what, fmt::format("'{}' has the key '{}', which looks at a mesh in memory", step.name, key),
                "leave it out, or " + way_out, step.where);
        if (step.stage->why_not_on_cells)
            if (const auto why = step.stage->why_not_on_cells(step.options.get()))
                refuse_cells(what, fmt::format("{}: {}", step.name, *why),
                             "leave that option out, or " + way_out, step.where);
        if (step.stage->loads != (i == 0))
            refuse_cells(what, "one load comes first", "load all files in one step, or " + way_out,
                         step.where);
        if (step.stage->ends_cells) return i + 1;
    }
    return steps.size();
}

} // namespace

CellPlan plan_cells(const Plan& plan, const CellSettings& settings) {
    using When = CellSettings::When;
    if (settings.when == When::never || (settings.memory == 0 && settings.when == When::automatic)) return {};
    std::vector<PlannedFile> inputs;
    for (const PlannedFile& file : planned_files(plan.steps, plan.places))
        if (!file.written && !file.shapes) inputs.push_back(file);
    std::uint64_t faces = 0;
    for (const PlannedFile& file : inputs) faces += cells::estimated_faces(file.path);
    const std::string needed = sized(cells::memory_in_core(faces));
    CellPlan cells;
    if (settings.when == When::automatic && cells::memory_in_core(faces) <= settings.memory) {
        cells.why = fmt::format("in memory: about {} faces need about {}, --memory gives {}", grouped(faces),
                                needed, sized(settings.memory));
        return cells;
    }
    const std::string what = settings.when == When::always
                                 ? "--partition always"
                                 : fmt::format("about {} faces need about {} in memory, --memory gives {}",
                                               grouped(faces), needed, sized(settings.memory));
    const std::string way_out = settings.when == When::always
                                    ? "use --partition auto"
                                    : "give more memory, or --partition never to try it all the same";
    if (inputs.empty()) refuse_cells(what, "cells are made of files", way_out, {});
    for (const PlannedFile& file : inputs)
        if (const auto why = cells::why_not_streamed(file.path))
            refuse_cells(what, fmt::format("'{}' cannot be read in pieces: {}", file.path.string(), *why),
                         "write it as binary PLY or STL, or " + way_out, file.where);
    cells.steps = steps_on_cells(plan.steps, what, way_out);
    const Step& last = plan.steps[cells.steps - 1];
    cells.why = last.stage->ends_cells ? fmt::format("in cells on disk up to '{}': {}", last.name, what)
                                       : fmt::format("in cells on disk: {}", what);
    return cells;
}

} // namespace facetmill::pipeline

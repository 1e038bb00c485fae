#include "pipeline/cells.hpp"

#include "base/text/readable_numbers.hpp"
#include "cells/hierarchy/hierarchy.hpp"
#include "cells/sources/face_source.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

[[noreturn]] void refuse_cells(const std::string& what, const std::string& why, const std::string& hint,
                               const Mark& where) {
    throw Error(ErrorKind::usage, "E-CELLS", fmt::format("{}: {}", what, why), hint, where);
}

/// The common key of a step that needs the whole scene, or null.
const char* key_in_the_way(const Step& step) {
    if (step.when && !step.when->known) return "when";
    if (step.ensure) return "ensure";
    if (!step.only.patterns.empty()) return "only";
    return nullptr;
}

std::vector<std::string> stages_on_cells() {
    std::vector<std::string> names;
    for (const StageInfo& stage : stages())
        if (stage.works_on_cells) names.push_back(stage.name);
    return names;
}

/// The number of first steps that work on cells: up to the step that makes the mesh small, or all.
std::size_t steps_on_cells(const Steps& steps, const std::string& what, const std::string& way_out) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Step& step = steps[i];
        if (step.kind != Step::Kind::stage || !step.info->works_on_cells)
            refuse_cells(
                what, fmt::format("'{}' cannot work on a mesh in cells", step.name),
                fmt::format("put it after simplify or clip, which make the mesh small, or {} ({} can)",
                            way_out, fmt::join(stages_on_cells(), ", ")),
                step.where);
        if (step.when && step.when->known && !*step.when->known)
            refuse_cells(what, fmt::format("'{}' is skipped", step.name), "remove the step, or " + way_out,
                         step.where);
        if (const char* key = key_in_the_way(step))
            refuse_cells(what,
                         fmt::format("'{}' has the key '{}', which needs the mesh in memory", step.name, key),
                         "leave it out, or " + way_out, step.where);
        if (const auto why = step.stage->why_not_on_cells())
            refuse_cells(what, fmt::format("{}: {}", step.name, *why), "remove that option, or " + way_out,
                         step.where);
        if (step.info->loads != (i == 0))
            refuse_cells(what, "the pipeline must begin with a single load",
                         "load all files in one step, or " + way_out, step.where);
        if (step.info->ends_cells) return i + 1;
    }
    return steps.size();
}

std::uint64_t estimated_faces(const std::vector<PlannedFile>& inputs) {
    std::uint64_t faces = 0;
    for (const PlannedFile& file : inputs) faces += cells::estimated_faces(file.path);
    return faces;
}

/// The size of the mesh that the cells must hold.
struct Faces {
    std::uint64_t read = 0, most = 0; ///< in the files; the maximum of all steps on cells

    std::uint64_t memory() const { return cells::memory_in_core(most); }
    std::string needs(const CellSettings& settings) const {
        const std::string growth = most > read ? fmt::format(", and the {} they become,", grouped(most)) : "";
        return fmt::format("about {} faces{} need about {} of memory, but --memory allows {}", grouped(read),
                           growth, sized(memory()), sized(settings.memory));
    }
};

/// Steps multiply the faces until a step makes the mesh small.
Faces faces_of(const Steps& steps, const std::vector<PlannedFile>& inputs) {
    Faces faces;
    faces.read = estimated_faces(inputs);
    constexpr double countable = 1e15; // larger numbers are refused where they arise
    double now = static_cast<double>(faces.read), most = now;
    for (const Step& step : steps) {
        if (step.kind != Step::Kind::stage || step.info->ends_cells) break;
        if (step.when && step.when->known && !*step.when->known) continue;
        now *= step.stage->triangles_of_one();
        most = std::max(most, now);
    }
    faces.most = std::max(faces.read, static_cast<std::uint64_t>(std::min(most, countable)));
    return faces;
}

std::vector<PlannedFile> mesh_inputs(const Plan& plan) {
    std::vector<PlannedFile> inputs;
    for (const PlannedFile& file : planned_files(plan.steps, plan.places))
        if (!file.written && !file.shapes) inputs.push_back(file);
    return inputs;
}

[[noreturn]] void refuse_jobs(const std::string& why, const std::string& hint, const Mark& where = {}) {
    throw Error(ErrorKind::usage, "E-EXPORT", why, hint, where);
}

} // namespace

CellPlan plan_cells(const Plan& plan, const CellSettings& settings) {
    using When = CellSettings::When;
    if (settings.when == When::never || (settings.memory == 0 && settings.when == When::automatic)) return {};
    const std::vector<PlannedFile> inputs = mesh_inputs(plan);
    const Faces faces = faces_of(plan.steps, inputs);
    CellPlan cells;
    if (settings.when == When::automatic && faces.memory() <= settings.memory) {
        cells.why = "in memory: " + faces.needs(settings);
        return cells;
    }
    const std::string what = settings.when == When::always ? "--partition always" : faces.needs(settings);
    const std::string way_out = settings.when == When::always
                                    ? "use --partition auto"
                                    : "give more memory, or use --partition never to try in memory anyway";
    if (inputs.empty()) refuse_cells(what, "only files can be divided into cells", way_out, {});
    for (const PlannedFile& file : inputs)
        if (const auto why = cells::why_not_streamed(file.path))
            refuse_cells(what,
                         fmt::format("'{}' cannot be read in pieces: {}", file.path.generic_string(), *why),
                         "write it as binary PLY or STL, or " + way_out, file.where);
    cells.steps = steps_on_cells(plan.steps, what, way_out);
    const Step& last = plan.steps[cells.steps - 1];
    cells.why = last.info->ends_cells ? fmt::format("in cells on disk up to '{}': {}", last.name, what)
                                      : fmt::format("in cells on disk: {}", what);
    return cells;
}

void require_jobs(const Plan& plan, const CellPlan& cells) {
    if (cells.steps == 0)
        refuse_jobs(
            fmt::format("the run has no cells: {}", cells.why.empty() ? "--partition never" : cells.why),
            "use --partition always, or run it without jobs");
    const Step& last = plan.steps[cells.steps - 1];
    if (last.info->name != "simplify")
        refuse_jobs(
            fmt::format("'{}' works on cells by itself: only simplify can be divided into jobs", last.name),
            "use facetmill run, which is a single job", last.where);
    for (std::size_t i = 1; i + 1 < cells.steps; ++i) {
        const Step& step = plan.steps[i];
        if (!step.info->checks && !step.info->tells && !step.info->moves)
            refuse_jobs(fmt::format("each job would do '{}' again before it simplifies", step.name),
                        "write its result in a separate run, and load that", step.where);
    }
}

CellJobs plan_cell_jobs(const Plan& plan, const CellSettings& settings, std::size_t count) {
    require_jobs(plan, plan_cells(plan, settings));
    CellJobs jobs;
    constexpr std::uint64_t faces_of_job = 2000000, most = 64;
    jobs.count = count > 0 ? count
                           : static_cast<std::size_t>(std::clamp<std::uint64_t>(
                                 estimated_faces(mesh_inputs(plan)) / faces_of_job, 2, most));
    const Headers headers = read_headers(plan);
    jobs.inputs = planned_inputs(plan, headers);
    jobs.outputs = planned_outputs(plan, headers);
    return jobs;
}

} // namespace facetmill::pipeline

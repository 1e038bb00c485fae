#include "pipeline/rehearsal.hpp"

#include "io/outputs/output_files.hpp"
#include "pipeline/run.hpp"

#include <algorithm>
#include <set>

namespace facetmill::pipeline {

namespace {

namespace fs = std::filesystem;

/// True if the names of images may depend on the step: it changes the scene, or writes images.
bool matters(const Step& step) {
    if (!step.info) return true;
    if (step.info->checks) return false;
    if (!step.info->tells) return true;
    return step.stage && step.stage->files().images.has_value();
}

/// The steps that matter, without contracts.
Steps those_that_matter(const Steps& steps) {
    Steps some;
    for (const Step& step : steps) {
        if (!matters(step)) continue;
        Step one = step;
        one.ensure.reset();
        for (Arm& arm : one.arms) arm.steps = std::make_shared<Steps>(those_that_matter(*arm.steps));
        some.push_back(std::move(one));
    }
    return some;
}

/// True if a rehearsal consumes no input: data from a pipe can be read only once.
bool may_run(const Plan& plan) {
    if (!missing_inputs(plan).empty() || plan_cells(plan, {}).steps > 0) return false;
    const auto files = planned_files(plan.steps, plan.places);
    return std::none_of(files.begin(), files.end(), [](const PlannedFile& file) {
        return !file.written && (file.path == "-" || io::is_stream(file.path));
    });
}

/// The files that a run of these steps would write; none if it would fail.
std::optional<std::vector<fs::path>> files_of_run(const Plan& plan) {
    std::vector<fs::path> files;
    RunSettings settings;
    settings.read_back = false;
    settings.commit.names_only = true;
    settings.on_output = [&](const io::Outputs::File& file) { files.push_back(file.target); };
    if (run_plan(plan, settings).exit_code != 0) return {};
    return files;
}

} // namespace

Headers rehearsed_headers(const Plan& plan) {
    Headers headers = read_headers(plan);
    if (!headers.images_change || !headers.errors.empty() || !may_run(plan)) return headers;
    Plan rehearsal = plan;
    rehearsal.steps = those_that_matter(plan.steps);
    rehearsal.reports.clear();
    const auto files = files_of_run(rehearsal);
    if (!files) return headers;
    std::set<fs::path> named;
    for (const auto& file : planned_files(plan.steps, plan.places))
        if (file.written) named.insert(file.path.lexically_normal());
    headers.more_outputs.clear();
    for (const auto& file : *files)
        if (!named.contains(file.lexically_normal())) headers.more_outputs.push_back(file);
    return headers;
}

} // namespace facetmill::pipeline

#pragma once
// Runs a plan: stages in order, branches from the same scene, checks, contracts, and either all outputs or
// none.

#include "base/progress.hpp"
#include "pipeline/cells.hpp"
#include "pipeline/plan.hpp"
#include "pipeline/trace.hpp"

namespace facetmill::pipeline {

struct RunSettings {
    Progress* progress = nullptr;
    double time_limit = 0;           ///< seconds for the run, or 0 for no limit; see pipeline/time_limit.hpp
    std::vector<std::string> strict; ///< ids of warnings that fail; "*": all
    bool read_back = true;
    bool check_invariants = false; ///< checks mesh/invariants.hpp after every stage (for tests)
    std::optional<ModelRowSettings> model_row = {}; ///< measures the model for a table
    bool last_picture = false; ///< makes a small picture in the last stage's record, even without reports
    /// Makes the record of a page, even without reports; called at the end with the contents of its 3D view.
    std::function<void(const Json&)> on_view = {};
    cache::Store* store = nullptr; ///< source and destination of stage results; null: no cache
    io::CommitSettings commit{};   ///< how to commit outputs and reports
    CellSettings cells{};          ///< controls processing of meshes larger than memory on disk
    /// Called with messages about the reuse of kept cells.
    std::function<void(const std::string&)> on_kept_cells = {};
    /// Called at the end, with the history of each step.
    std::function<void(const Trace&)> on_trace = {};
    /// Called after each stage, with its resolved options.
    std::function<void(const report::StageRecord&)> on_stage = {};
    /// Called for each output when all are ready, before the first is renamed to its final name; an Error
    /// that it throws fails the run.
    std::function<void(const io::Outputs::File&)> on_output = {};
    /// Called for every warning immediately, unless strict makes it an error.
    std::function<void(const Diagnostic&)> on_warning;
};

/// The error (E-STRICT) that --strict makes of a warning; none if it does not apply.
[[nodiscard]] std::optional<Diagnostic> strict_failure(const Diagnostic& warning,
                                                       const std::vector<std::string>& strict);

/// Writes the reports of a pipeline that cannot run because of these problems (exit code 2). Do not call it
/// for a plan with file collisions, because a report may be involved. Returns their paths, relative to the
/// output folder. Throws an output error when a report cannot be written.
[[nodiscard]] std::vector<std::string> report_refusal(const Plan& plan, const Problems& problems);

/// Runs the plan, writes its outputs (all or none) and its reports (always), and returns the record with
/// exit_code and errors. Throws only for bugs.
[[nodiscard]] report::RunRecord run_plan(const Plan& plan, const RunSettings& settings);

} // namespace facetmill::pipeline

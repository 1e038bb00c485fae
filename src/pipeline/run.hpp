#pragma once
// Plan -> run: the stages in order, branches from the same scene, checks, contracts, and all outputs or none.

#include "base/progress.hpp"
#include "pipeline/cells.hpp"
#include "pipeline/plan.hpp"
#include "pipeline/trace.hpp"

namespace facetmill::pipeline {

struct RunSettings {
    Progress* progress = nullptr;
    std::vector<std::string> strict; ///< ids of warnings that fail; "*": all
    bool read_back = true;
    bool check_invariants = false; ///< mesh/invariants.hpp after every stage (tests)
    bool last_picture = false; ///< the record of the last stage gets a small picture, whatever the reports
    /// The record is for a page, whatever the reports: called at the end with what its 3D view shows.
    std::function<void(const Json&)> on_view = {};
    cache::Store* store = nullptr; ///< results of stages are taken from it, and put there; none: no cache
    io::CommitSettings commit{};   ///< of outputs and reports
    CellSettings cells{};          ///< whether a mesh that is larger than memory is processed on disk
    /// Is told in words what of kept cells is taken up, and why not.
    std::function<void(const std::string&)> on_kept_cells = {};
    /// Called at the end, with what became of each step.
    std::function<void(const Trace&)> on_trace = {};
    /// Called after each stage, with what its options were resolved to.
    std::function<void(const report::StageRecord&)> on_stage = {};
    /// Called for each output when all are ready, before the first gets its name; an Error that it throws
    /// fails the run.
    std::function<void(const io::Outputs::File&)> on_output = {};
    /// Called for every warning as it arises, unless strict makes it an error.
    std::function<void(const Diagnostic&)> on_warning;
};

/// The error (E-STRICT) that --strict makes of a warning; none when it lets it pass.
std::optional<Diagnostic> strict_failure(const Diagnostic& warning, const std::vector<std::string>& strict);

/// Writes the reports of a pipeline that is not run because of these problems (exit code 2). Not for a plan
/// whose files collide: a report may be one of them. Returns their paths, from the output folder. Throws
/// output when one cannot be written.
std::vector<std::string> report_refusal(const Plan& plan, const Problems& problems);

/// Runs the plan, writes its outputs (all or none) and its reports (always), and returns the record;
/// exit_code and errors in it say how it went. Throws only for bugs.
report::RunRecord run_plan(const Plan& plan, const RunSettings& settings);

} // namespace facetmill::pipeline

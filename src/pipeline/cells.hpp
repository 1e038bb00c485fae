#pragma once
// Decides which of a plan's first steps work on cells, because the mesh exceeds the memory limit.

#include "cells/partition/cell_job.hpp"
#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

struct CellSettings {
    enum class When { automatic, always, never };
    When when = When::automatic;     ///< automatic: if the mesh is estimated to need more than `memory`
    std::uint64_t memory = 0;        ///< limit in bytes; 0: no limit
    std::filesystem::path scratch{}; ///< the folder for temporary data
    std::filesystem::path kept{};    ///< folder that keeps cells for later runs; empty: cells are not kept
    std::optional<cells::CellJob> job{}; ///< the only job to run; it needs `kept`
};

struct CellPlan {
    std::size_t steps = 0; ///< number of first steps on cells; 0: all are in memory
    std::string why;       ///< a sentence for the user; empty if cells were not requested
};

/// Decides by the headers and sizes of the inputs. Throws a usage error (E-CELLS), with a way out, when the
/// mesh needs cells but a stage, an option or a file does not support them.
[[nodiscard]] CellPlan plan_cells(const Plan& plan, const CellSettings& settings);

/// Throws a usage error (E-EXPORT) if a run cannot be divided into jobs, because no step simplifies in
/// cells, or an earlier stage creates new cells.
void require_jobs(const Plan& plan, const CellPlan& cells);

/// The jobs of a run in cells: see cells/partition/cell_job.hpp.
struct CellJobs {
    std::size_t count = 0;                              ///< number of simplifying jobs
    std::vector<std::filesystem::path> inputs, outputs; ///< inputs and outputs of the run
};
/// count: number of simplifying jobs; 0: suited to the inputs. Throws the errors of require_jobs.
[[nodiscard]] CellJobs plan_cell_jobs(const Plan& plan, const CellSettings& settings, std::size_t count);

} // namespace facetmill::pipeline

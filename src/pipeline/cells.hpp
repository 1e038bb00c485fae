#pragma once
// Which of a plan's first steps work on cells, because the mesh is larger than the memory that is given.

#include "cells/partition/cell_job.hpp"
#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

struct CellSettings {
    enum class When { automatic, always, never };
    When when = When::automatic;     ///< automatic: where the mesh is estimated to need more than `memory`
    std::uint64_t memory = 0;        ///< bytes; 0: no limit is given
    std::filesystem::path scratch{}; ///< the folder for temporary data
    std::filesystem::path kept{};    ///< the folder in which cells are kept; empty: they are not
    std::optional<cells::CellJob> job{}; ///< all there is to do; it needs `kept`
};

struct CellPlan {
    std::size_t steps = 0; ///< how many of the first; 0: all are in memory
    std::string why;       ///< a sentence for people; empty: nobody asked
};

/// Decides by the headers and sizes of the inputs. Throws usage (E-CELLS) when the mesh needs cells and a
/// stage, an option or a file cannot be processed so, with the way out.
CellPlan plan_cells(const Plan& plan, const CellSettings& settings);

/// Throws usage (E-EXPORT) where a run cannot be divided into jobs: nothing is simplified in cells, or a
/// stage before that makes cells anew.
void require_jobs(const Plan& plan, const CellPlan& cells);

/// A run in cells as jobs: see cells/partition/cell_job.hpp.
struct CellJobs {
    std::size_t count = 0;                              ///< of those that simplify
    std::vector<std::filesystem::path> inputs, outputs; ///< of the run
};
/// count: jobs that simplify; 0: as many as suit the inputs. Throws as require_jobs.
CellJobs plan_cell_jobs(const Plan& plan, const CellSettings& settings, std::size_t count);

} // namespace facetmill::pipeline

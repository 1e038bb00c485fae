#pragma once
// Which of a plan's first steps work on cells, because the mesh is larger than the memory that is given.

#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

struct CellSettings {
    enum class When { automatic, always, never };
    When when = When::automatic;     ///< automatic: where the mesh is estimated to need more than `memory`
    std::uint64_t memory = 0;        ///< bytes; 0: no limit is given
    std::filesystem::path scratch{}; ///< the folder for temporary data
    std::filesystem::path kept{};    ///< the folder in which cells are kept; empty: they are not
};

struct CellPlan {
    std::size_t steps = 0; ///< how many of the first; 0: all are in memory
    std::string why;       ///< a sentence for people; empty: nobody asked
};

/// Decides by the headers and sizes of the inputs. Throws usage (E-CELLS) when the mesh needs cells and a
/// stage, an option or a file cannot be processed so, with the way out.
CellPlan plan_cells(const Plan& plan, const CellSettings& settings);

} // namespace facetmill::pipeline

#pragma once
// The stage write for a mesh in cells.

#include "stages/write/options.hpp"

namespace facetmill::write_stage {

[[nodiscard]] std::optional<std::string> why_not_on_cells(const WriteOptions& o);
/// Writes the cells to a file piece by piece. The cells stay available for the next stage.
void write_on_cells(const WriteOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::write_stage

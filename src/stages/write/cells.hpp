#pragma once
// write, of a mesh in cells.

#include "stages/write/options.hpp"

namespace facetmill::write_stage {

[[nodiscard]] std::optional<std::string> why_not_on_cells(const WriteOptions& o);
/// Writes the cells as one file, piece by piece; they go on to the next stage.
void write_on_cells(const WriteOptions& o, CellFlow& flow, Context& context);

} // namespace facetmill::write_stage

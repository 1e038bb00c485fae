#pragma once
// Predicts a plan's output files if only its stages can determine them. For example, textures may be
// converted to WebP only where that is smaller, and unused images dropped.

#include "pipeline/plan.hpp"

namespace facetmill::pipeline {

/// read_headers, with the exact additional output files. If stages change images (Headers::images_change), it
/// runs the relevant stages without writing, which takes their time. If that is impossible, an input is
/// missing, or the mesh exceeds memory, it keeps the file names without those stages.
[[nodiscard]] Headers rehearsed_headers(const Plan& plan);

} // namespace facetmill::pipeline

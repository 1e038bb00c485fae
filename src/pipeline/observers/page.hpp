#pragma once
// What the pictures of a page and the deviations of Markdown have in common.

#include "pipeline/observers.hpp"

namespace facetmill::pipeline {

report::PageStep page_step(const Step& step);
/// References of arms, failures of contracts, and the scene at the end. scene_for: as Watch has it.
void watch_results(Engine& engine, report::Page& page, const char* scene_for);

} // namespace facetmill::pipeline

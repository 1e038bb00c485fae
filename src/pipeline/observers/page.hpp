#pragma once
// Shared by the pictures of a page and the deviations of Markdown reports.

#include "pipeline/observers.hpp"

namespace facetmill::pipeline {

[[nodiscard]] report::PageStep page_step(const Step& step);
/// Observes references of arms, failures of contracts, and the final scene. scene_for: see Watch.
void watch_results(Engine& engine, report::Page& page, const char* scene_for);

} // namespace facetmill::pipeline

#pragma once
// The observers of a run, one file each in observers/. An observer without work in the settings and the plan
// does not register.

#include "pipeline/engine.hpp"
#include "report/page_view.hpp"

namespace facetmill::pipeline {

/// Shows the number and the name of each stage as progress.
void watch_progress(Engine& engine);
/// Records how each step was done. The cache also changes the last entry.
void watch_trace(Engine& engine, Trace& trace);
/// Fails a stage that breaks an invariant of scenes.
void watch_invariants(Engine& engine);
/// Records the properties of the final scene for reports, and small pictures of it for an index. If a check
/// fails, the properties describe the scene that failed.
void watch_record(Engine& engine);
/// Measures the model for a table: as loaded, when a check fails, and at the end.
void watch_model(Engine& engine);
/// Collects the contents of a page: pictures, distances, histograms.
void watch_pictures(Engine& engine, report::Page& page);
/// Collects deviations for Markdown reports without a page.
void watch_deviation(Engine& engine, report::Page& page);
/// Adds the 3D view to a page, after its pictures.
void watch_view(Engine& engine, report::PageView& view);
/// Reports finished stages to the settings' callback.
void watch_console(Engine& engine);

/// Shared by pictures and deviations: observes references of arms, failures of contracts, and the final
/// scene.
void watch_results(Engine& engine, report::Page& page, const char* scene_for);
[[nodiscard]] report::PageStep page_step(const Step& step);
/// makes_page: true if the run creates a page; the other: true if it has a report in this format.
bool makes_page(const Engine& engine);
/// True if a check of the event's stage failed with severity error.
bool fails_check(const Engine& engine, const Event& event);
bool has_report(const Engine& engine, std::string_view suffix);

} // namespace facetmill::pipeline

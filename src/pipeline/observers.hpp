#pragma once
// Who watches a run, one file each in observers/. Those that find nothing to do in the settings and the plan
// do not watch.

#include "pipeline/engine.hpp"
#include "report/page_view.hpp"

namespace facetmill::pipeline {

/// The number and the name of each stage, for people who wait.
void watch_progress(Engine& engine);
/// What became of each step. The cache changes the last entry, too.
void watch_trace(Engine& engine, Trace& trace);
/// Fails a stage that breaks an invariant of scenes.
void watch_invariants(Engine& engine);
/// The properties of the scene at the end, for reports; small pictures of it, for an index.
void watch_record(Engine& engine);
/// What a page shows: pictures, distances, histograms.
void watch_pictures(Engine& engine, report::Page& page);
/// How far results are off, for Markdown without a page.
void watch_deviation(Engine& engine, report::Page& page);
/// The 3D view of a page, after its pictures.
void watch_view(Engine& engine, report::PageView& view);
/// Stages for whoever shows them as they end.
void watch_console(Engine& engine);

/// For pictures and deviations alike: references of arms, failures of contracts, and the scene at the end.
void watch_results(Engine& engine, report::Page& page, const char* scene_for);
report::PageStep page_step(const Step& step);
/// Whether the run makes a page; whether it has a report in this format.
bool makes_page(const Engine& engine);
bool has_report(const Engine& engine, std::string_view suffix);

} // namespace facetmill::pipeline

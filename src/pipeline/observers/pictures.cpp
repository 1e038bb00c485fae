#include "pipeline/observers.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::pipeline {

bool has_report(const Engine& engine, std::string_view suffix) {
    const auto& reports = engine.plan.reports;
    return std::any_of(reports.begin(), reports.end(),
                       [&](const std::string& path) { return path.ends_with(suffix); });
}

bool makes_page(const Engine& engine) { return engine.settings.on_view || has_report(engine, ".html"); }

bool fails_check(const Engine& engine, const Event& event) {
    const auto& checks = engine.record().checks;
    return std::any_of(
        checks.begin() + static_cast<std::ptrdiff_t>(event.first_check), checks.end(),
        [](const report::Check& check) { return !check.passed && check.severity == Severity::error; });
}

report::PageStep page_step(const Step& step) {
    const StageInfo& info = *step.info;
    return {step.name, info.loads, info.moves, info.checks,
            info.measures_deviation || (step.ensure && step.ensure->deviation)};
}

void watch_results(Engine& engine, report::Page& page, const char* scene_for) {
    const auto references = std::make_shared<std::vector<std::shared_ptr<report::Page::Reference>>>();
    engine.watches.push_back({Event::Kind::arm, nullptr, [&page, references](const Event&) {
                                  references->push_back(page.reference());
                              }});
    engine.watches.push_back({Event::Kind::arm_done, nullptr, [&page, references](const Event&) {
                                  page.set_reference(references->back());
                                  references->pop_back();
                              }});
    engine.watches.push_back({Event::Kind::judged, scene_for, [&page](const Event& event) {
                                  page.failures(event.step->name, *event.scene, event.first_check);
                              }});
    engine.watches.push_back(
        {Event::Kind::ended, scene_for, [&page](const Event& event) { page.at_end(*event.scene); }});
}

void watch_pictures(Engine& engine, report::Page& page) {
    if (!makes_page(engine)) return;
    const char* const what = "a picture";
    const auto before = [&page](const Event& event) { page.before(page_step(*event.step), *event.scene); };
    const auto after = [&](const Event& event) {
        const ProgressScope share = engine.beside_stages(fmt::format("picture after {}", event.step->name));
        page.after(page_step(*event.step), *event.scene, *event.stage, event.first_output);
        page.failures(event.step->name, *event.scene, event.first_check);
    };
    engine.watches.push_back({Event::Kind::before, what, before});
    engine.watches.push_back({Event::Kind::after, what, after});
    watch_results(engine, page, what);
}

} // namespace facetmill::pipeline
